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

test("radii that fit are rounded down, what is missing is rounded up, and neither where it is exact", async () => {
  const { metres_at_most, metres_at_least } = await load("numbers");
  assert.deepEqual([metres_at_most(0.2947457), metres_at_most(0.2947457, 2), metres_at_least(0.2947457)], ["0.294", "0.29", "0.295"]);
  for (const exact of [0.001, 0.07, 0.29, 0.3, 1.005, 12]) assert.deepEqual([metres_at_most(exact), metres_at_least(exact)], [String(exact), String(exact)]);
  const { join_text, reason_text } = await load("answer_text");
  assert.match(join_text({ a: 0, b: 1, radius: 0.2947457, place: [0, 0, 0], by: "obstacle" }, () => "some"), /^radius 0\.294 m/);
  const answer = { status: "no_route", radius: 0.3, seconds: { total: 0 }, blocked: { radius: 0.2947457, place: [0, 0, 0], by: "obstacle" } };
  assert.match(reason_text(answer), /too narrow by 0\.006 m/);
});

test("clearances are rounded down, and small parts of space have some volume", async () => {
  const { clearance_text } = await load("answer_text");
  assert.deepEqual([clearance_text(0.40551622), clearance_text(0.4, "clearance "), clearance_text(null)], ["0.405 m", "clearance 0.4 m", "no obstacle near"]);
  const { volume_text, counted } = await load("numbers");
  assert.deepEqual([volume_text(0.000125), volume_text(0.02), volume_text(12.34)], ["less than 0.001 m³", "0.02 m³", "12.3 m³"]);
  assert.deepEqual([counted(1, "edge", "edges"), counted(1234, "edge", "edges")], ["1 edge", "1,234 edges"]);
});

test("reasons name what stands in the form, not options of the command line", async () => {
  const { error_text, reason_text } = await load("answer_text");
  const reasons = {
    "the start (0, 0, 0) cannot be used: it is 0.1 m from the nearest obstacle, less than the radius of 0.3 m: move it, or let --snap do so, or give --escape to begin or end there, or give a --radius of at most 0.3 m": /Radius of at most/,
    "start and goal are not connected at a radius of 0.5 m, but they are at 0.4 m: give that --radius": /give that Radius$/,
    "the map was built for robots of a radius of 0.3 m and more, asked for 0.2 m: give a larger --radius, or build the map with a smaller --min-clearance": /a larger Radius, or build/,
    "the limit came before a path was found: give a larger --time-limit, or --iteration-limit where the planner samples": /planner graph/,
  };
  for (const [reason, expected] of Object.entries(reasons)) {
    const text = reason_text({ status: "no_route", reason, radius: 0.3, seconds: { total: 0 } });
    assert.match(text, expected);
    assert.doesNotMatch(text, /--(?!min-clearance)/, "only what builds a map is of the command line"); 
  }
  assert.equal(error_text(new Error("prefer_clearance '-3': is out of range (give one)")), "Prefer clearance '-3': is out of range (give one)");
  assert.equal(error_text(new Error("from: is missing")), "Start: is missing");
  assert.equal(error_text(new Error("the server does not answer: start it")), "the server does not answer: start it");
});

test("no narrow places: nothing to join, or nothing that joins", async () => {
  const { no_joins_text } = await load("answer_text");
  assert.match(no_joins_text(0), /fits nowhere/);
  assert.match(no_joins_text(1), /are connected/);
  assert.match(no_joins_text(3), /3 parts/);
});

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
