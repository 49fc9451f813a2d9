// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

// What the page makes of bytes, where no page is needed to see it.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import test from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import { join } from "node:path";
import { folder } from "./program.mjs";

const viewer = fileURLToPath(new URL("../../viewer/", import.meta.url));
if (!existsSync(join(viewer, "node_modules/esbuild"))) process.exit(77);
const { buildSync } = createRequire(join(viewer, "package.json"))("esbuild");

/** A module of the page. */
function load(name) {
  const outfile = join(folder, `${name}.mjs`);
  buildSync({ entryPoints: [join(viewer, `src/${name}.ts`)], outfile, bundle: true, format: "esm" });
  return import(pathToFileURL(outfile).href);
}

/** An event of a map that grows: blocks, each with a quad in its last voxel. */
function event(origin, voxel_size, blocks) {
  const bytes = new DataView(new ArrayBuffer(36 + 20 * blocks.length));
  [...origin, voxel_size].forEach((x, i) => bytes.setFloat64(8 * i, x, true));
  bytes.setUint32(32, blocks.length, true);
  blocks.forEach((block, i) => {
    [...block, 1, 0o777 | (3 << 9) | (1 << 12)].forEach((x, k) => bytes.setInt32(36 + 20 * i + 4 * k, x, true));
  });
  return bytes.buffer;
}

test("cells of a live map are where they are, however wide it is", async () => {
  const { LiveSurface } = await load("live_surface");
  for (const far of [10, 8191, 8192, 100000]) {
    const live = new LiveSurface();
    live.apply(event([5, 6, 7], 0.5, [[-2, 0, 0], [far - 2, 1, 0]]));
    const { origin, cells, sizes, count } = live.whole();
    assert.equal(count, 2);
    assert.deepEqual(origin, [5 - 8, 6, 7]);
    assert.deepEqual([...cells], [7, 7, 7, 3, 8 * far + 7, 15, 7, 3]);
    assert.deepEqual([...sizes], [2, 1, 0, 0, 2, 1, 0, 0]);
  }
});
