// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

// The program under test, and maps for it.
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export const program = process.env.RIDGEWAY_PROGRAM ?? "build/bin/ridgeway";
export const data = process.env.RIDGEWAY_DATA ?? "data";
export const folder = mkdtempSync(join(tmpdir(), "ridgeway-viewer-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));

export function run(...words) {
  return spawnSync(program, words, { encoding: "utf8", maxBuffer: 1 << 28 });
}
export function run_json(...words) {
  return JSON.parse(run(...words, "--json").stdout);
}

/** Two rooms side by side, each 3 m x 4 m x 2 m, and a door 1.2 m wide in the wall x = 0, or none. */
export function rooms({ name = "rooms", has_door = true, options = ["--min-clearance", "0.3"] } = {}) {
  const lines = ["x y z"];
  for (let y = -20; y < 20; ++y)
    for (let z = 0; z < 20; ++z)
      if (!has_door || y < -6 || y >= 6) lines.push(`0.05 ${(0.1 * y + 0.05).toFixed(2)} ${(0.1 * z + 0.05).toFixed(2)}`);
  // The floor, so that there is something to click on.
  for (let x = -30; x < 30; ++x)
    for (let y = -20; y < 20; ++y) lines.push(`${(0.1 * x + 0.05).toFixed(2)} ${(0.1 * y + 0.05).toFixed(2)} -0.05`);
  const points = join(folder, `${name}.xyz`);
  writeFileSync(points, lines.join("\n"));
  const map = join(folder, `${name}.ridge`);
  execFileSync(program, ["build", points, "-o", map, "--voxel-size", "0.1", "--bounds=-3,-2,-0.1,3,2,2", ...options, "--quiet"]);
  return map;
}

/** The scan of an office, 44 m x 18 m. */
export function office() {
  const map = join(folder, "fr_079.ridge");
  execFileSync(program, ["build", join(data, "fr_079.bt"), "-o", map, "--min-clearance", "0.3", "--quiet"]);
  return map;
}

/** Starts a run that is followed by a page; skips all tests (77) where the program has no page. */
export async function follow(...words) {
  const server = spawn(program, words, { stdio: ["ignore", "ignore", "pipe"] });
  let err = "";
  const address = await new Promise((resolve, reject) => {
    server.stderr.on("data", (text) => {
      err += text;
      const found = /open (http:\S+)/.exec(err);
      if (found) resolve(found[1]);
    });
    server.on("exit", () => (err.includes("has no page") ? process.exit(77) : reject(new Error(err))));
  });
  return running(server, address);
}

function running(server, address) {
  server.removeAllListeners("exit");
  const ended = new Promise((resolve) => server.on("exit", (code, signal) => resolve({ code, signal })));
  return { server, address, port: Number(new URL(address).port), ended, stop: () => server.kill("SIGINT") && ended };
}

/** Serves a map; skips all tests (77) where the program has no page. */
export async function view(map, port = 0) {
  const server = spawn(program, ["view", map, "--json", "--port", String(port)], { stdio: ["ignore", "pipe", "pipe"] });
  let out = "";
  let err = "";
  server.stderr.on("data", (text) => (err += text));
  const address = await new Promise((resolve, reject) => {
    server.stdout.on("data", (text) => {
      out += text;
      if (out.includes("}")) resolve(JSON.parse(out).address);
    });
    server.on("exit", () => (err.includes("has no page") ? process.exit(77) : reject(new Error(err))));
  });
  return running(server, address);
}
