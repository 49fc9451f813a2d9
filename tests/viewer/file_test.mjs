// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

// The page as one file, which plans by itself, against the program.
import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { join } from "node:path";
import test, { after, before } from "node:test";
import { pathToFileURL } from "node:url";
import { difference, launch, open, pixels, text_of } from "./browser.mjs";
import { folder, office, run, run_json } from "./program.mjs";

let browser, page, map;
const file = join(folder, "map.html");
before(async () => {
  map = office();
  const exported = run("export", map, "-o", file);
  if (/built without/.test(exported.stderr)) process.exit(77);
  assert.equal(exported.status, 0, exported.stderr);
  browser = await launch();
  page = await open(browser, pathToFileURL(file).href);
}, { timeout: 300_000 });
after(() => browser?.close());

const ask = (path, parameters) =>
  page.evaluate(async ([path, parameters]) => JSON.parse(new TextDecoder().decode(await window.ridgeway.app.source.ask(path, parameters))), [path, parameters]);

test("opens from the disk, smaller than 15 MB, and asks nobody", async () => {
  assert.ok(statSync(file).size < 15e6, `${statSync(file).size} bytes`);
  assert.equal(await page.evaluate(() => document.body.dataset.ready), "yes", await text_of(page, "#loading"));
  assert.deepEqual(page.complaints, []);
  for (const address of page.asked) assert.match(address, /^(file|blob|data):/);
  const { drawn, colours } = await pixels(page);
  assert.ok(drawn > 0.05 && colours > 20);
});

test("plans what the program plans: the same waypoints", async () => {
  const queries = [["1.3,-2.8,1.2", "26,-0.1,1.3", "0.3"], ["0,0,0.6", "10,0,0.6", "0.3"], ["0,0,0.6", "10,0,0.6", "0.45"], ["26,-0.1,1.3", "1.3,-2.8,1.2", "0.3"], ["14,0,1", "25.3,-0.1,1.3", "0.5"]];
  let found = 0;
  for (const [from, to, radius] of queries) {
    const mine = await ask("/api/plan", { from, to, radius });
    const its = run_json("plan", map, `--from=${from}`, `--to=${to}`, "--radius", radius);
    assert.equal(mine.status, its.status);
    assert.deepEqual(mine.waypoints, its.waypoints, `${from} to ${to} at ${radius}`);
    // Sums are rounded in another order.
    for (const key of ["length", "clearance"]) assert.ok(Math.abs(mine[key] - its[key]) <= 1e-12 * Math.max(1, its[key]), key);
    assert.equal(mine.reason, its.reason);
    found += mine.status === "ok";
  }
  assert.ok(found >= 3);
});

test("finds the same alternatives, and the same reason where there is none", async () => {
  const query = { from: "1.3,-2.8,1.2", to: "26,-0.1,1.3" };
  const routes = (await ask("/api/plan", { ...query, alternatives: "3" })).routes;
  const its = run_json("plan", map, `--from=${query.from}`, `--to=${query.to}`, "--alternatives", "3").routes;
  assert.deepEqual(routes.map((r) => r.waypoints), its.map((r) => r.waypoints));
  const cut_off = { from: "1.3,-2.8,1.2", to: "25.025,-3.925,1.575" };
  const none = await ask("/api/plan", cut_off);
  const why = run_json("plan", map, `--from=${cut_off.from}`, `--to=${cut_off.to}`);
  assert.equal(none.status, "no_route");
  assert.equal(none.reason, why.reason);
  assert.deepEqual(none.blocked, why.blocked);
});

test("flies along the route, stopping at corners", async () => {
  const flown = await ask("/api/trajectory", { from: "1.3,-2.8,1.2", to: "26,-0.1,1.3" });
  assert.equal(flown.status, "ok");
  assert.ok(flown.clearance >= 0.3 * (1 - 1e-6) - 1e-3);
  assert.ok(flown.duration > 10);
});

test("plans as a person uses it", async () => {
  const before = await pixels(page);
  await page.fill("#from", "1.3, -2.8, 1.2");
  await page.fill("#to", "26, -0.1, 1.3");
  await page.locator("#go").click();
  await page.locator("#length").waitFor({ timeout: 20_000 });
  assert.match(await text_of(page, "#length"), /^25\.817 m$/);
  assert.ok(difference(before, await pixels(page)) > 200);
});

test("where frames are slow, a surface is drawn finer when it is looked at from near", async () => {
  const is_fine = (frame_time, farther) => page.evaluate(([frame_time, farther]) => {
    const { stage, surface } = window.ridgeway;
    stage.turn(0, 0, farther);
    Object.assign(stage, { frame_time, coarse: false });
    stage.changed();
    stage.draw();
    return surface.mesh.geometry === surface.fine.geometry;
  }, [frame_time, farther]);
  assert.equal(await page.evaluate(() => window.ridgeway.surface.fine === window.ridgeway.surface.coarse), false);
  assert.equal(await is_fine(0, 2), true);
  assert.equal(await is_fine(1000, 1), false);
  assert.equal(await is_fine(1000, 0.05), true);
});

test("is refused where it would write over the map", () => {
  const refused = run("export", map, "-o", map);
  assert.equal(refused.status, 1);
});
