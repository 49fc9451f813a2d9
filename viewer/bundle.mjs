// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

// node bundle.mjs FOLDER [PLANNER]: the page's files, in a folder. PLANNER: the module that
// emscripten made of the planner; without it worker.js is empty.
import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const [folder, planner] = process.argv.slice(2);
if (!folder) throw new Error("usage: node bundle.mjs FOLDER [PLANNER]");
mkdirSync(folder, { recursive: true });

const options = {
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  legalComments: "inline",
  logLevel: "warning",
};
await build({
  ...options,
  entryPoints: [join(here, "src/main.ts")],
  outfile: join(folder, "page.js"),
});
await build({ ...options, entryPoints: [join(here, "src/page.css")], outfile: join(folder, "page.css") });
copyFileSync(join(here, "src/page.html"), join(folder, "page.html"));
if (planner) {
  await build({
    ...options,
    entryPoints: [join(here, "src/worker.ts")],
    alias: { planner },
    outfile: join(folder, "worker.js"),
  });
} else {
  writeFileSync(join(folder, "worker.js"), "");
}

// What would end the element early that the script or the style stands in, in a page of one file.
for (const [file, end] of [["page.js", "</script"], ["page.css", "</style"]]) {
  if (readFileSync(join(folder, file), "utf8").toLowerCase().includes(end))
    throw new Error(`${file} contains ${end}`);
}
