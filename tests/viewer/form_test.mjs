// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

// The form of the page: what is asked with it, what is wrong in it, and answers in another order than their questions.
import assert from "node:assert/strict";
import * as fs from "node:fs/promises";
import test, { after, before } from "node:test";
import { click_at, hold, launch, open, planned, set_control, text_of } from "./browser.mjs";
import { rooms, view } from "./program.mjs";

/** Where an answer is waited for that is never asked for. */
const kLimit = { timeout: 60_000 };

let map, served, browser, page;
before(async () => {
  map = rooms();
  served = await view(map);
  browser = await launch();
  page = await open(browser, served.address);
  await set("from", "-2, 1, 1");
  await planned(page, () => set("to", "2, -1, 1"));
}, { timeout: 120_000 });
after(async () => {
  await browser?.close();
  await served?.stop();
});

const set = (id, value) => set_control(page, id, value);

test("what waits is not lost when an end is taken away meanwhile, nor is what comes later", kLimit, async () => {
  const plan = await hold(page, "**/api/plan*");
  await planned(page, async () => {
    await set("radius", "0.31");
    await plan.asked;
    await set("radius", "0.32"); // waits
    await set("from", "");
    await plan.release();
  });
  assert.equal(await text_of(page, "#result"), "");
  await set("radius", "0.3");
  await planned(page, () => set("from", "-2, 1, 1"));
  assert.equal(await page.locator("#length").count(), 1, await text_of(page, "#result"));
});

/** Nothing is left of an earlier answer. */
async function nothing_is_shown(what) {
  assert.equal(await page.evaluate(() => window.ridgeway.app.query.shown.length), 0, what);
  assert.equal(await page.evaluate(() => window.ridgeway.app.routes.has_flight), false, what);
  assert.equal(await page.locator("#length").count(), 0, what);
  assert.equal(await page.locator("#command").textContent(), "", what);
  for (const id of ["flight", "show-place"]) assert.ok(await page.locator(`#${id}`).isHidden(), `${what}: ${id}`);
  assert.doesNotMatch(await text_of(page, "#legend"), /Route|Trajectory/, what);
}

test("a mistake is named as the form names it, and takes away the answer from before", async () => {
  for (const [id, wrong, right, message] of [["radius", "-1", "0.3", /^Radius '-1': /], ["prefer", "-3", "0", /^Prefer clearance '-3': /], ["snap", "-3", "0.5", /^Snap '-3': /], ["alternatives", "99", "1", /^Routes '99': /]]) {
    await planned(page, () => set(id, wrong));
    assert.match(await text_of(page, "#result"), message);
    await nothing_is_shown(`${id} ${wrong}`);
    await planned(page, () => set(id, right));
    assert.equal(await page.locator("#length").count(), 1, await text_of(page, "#result"));
  }
  await set("from", "hello");
  assert.equal(await page.getAttribute("#from", "aria-invalid"), "true");
  assert.match(await text_of(page, "#result"), /^Start is no place: give three numbers/);
  await nothing_is_shown("hello");
  await set("from", "");
  assert.equal(await page.getAttribute("#from", "aria-invalid"), null);
  assert.equal(await text_of(page, "#result"), "");
  await page.locator("#go").click();
  assert.match(await text_of(page, "#result"), /^Start is missing/);
  await planned(page, () => set("from", "-2, 1, 1"));
});

test("what is no number is not planned with", kLimit, async () => {
  for (const [id, typed, right, message] of [["radius", "1-2", "0.3", /^Radius is no number$/], ["snap", "1e", "0.5", /^Snap is no number$/], ["prefer", "1e", "0", /^Prefer clearance is no number$/], ["alternatives", "1e", "1", /^Routes is no number$/]]) {
    await page.locator(`#${id}`).selectText();
    await page.locator(`#${id}`).pressSequentially(typed);
    await page.locator(`#${id}`).press("Tab");
    assert.match(await text_of(page, "#result"), message);
    assert.equal(await page.getAttribute(`#${id}`, "aria-invalid"), "true");
    await nothing_is_shown(`${id} ${typed}`);
    await planned(page, () => set(id, right));
    assert.equal(await page.getAttribute(`#${id}`, "aria-invalid"), null);
    assert.equal(await page.locator("#length").count(), 1, await text_of(page, "#result"));
  }
  await page.locator("#speed").selectText();
  await page.locator("#speed").pressSequentially("1e");
  await page.locator("#speed").press("Tab");
  assert.equal(await text_of(page, "#no-flight"), "No trajectory: Speed is no number");
  await set("speed", "2");
  await page.evaluate(() => window.ridgeway.app.flight.flown);
});

test("an answer that is waited for is not covered up by the last one", kLimit, async () => {
  const plan = await hold(page, "**/api/plan*");
  await planned(page, async () => {
    await set("radius", "0.31");
    await plan.asked;
    await page.waitForFunction(() => document.getElementById("result").textContent === "Planning ...");
    await nothing_is_shown("while it plans");
    await plan.release();
  });
  assert.equal(await page.locator("#length").count(), 1, await text_of(page, "#result"));
  await planned(page, () => set("radius", "0.3"));
});

test("the flight has its command, of the limits in the form, and the route can be saved for it", async () => {
  const flight = () => page.locator("#flight-command").textContent();
  assert.match(await flight(), /^ridgeway trajectory rooms\.ridge --from=\S+ --to=\S+ --radius 0\.3 --snap 0\.5 --max-speed 2 --max-acceleration 2$/);
  const before = await text_of(page, "#clock");
  await set("acceleration", "0.5");
  await page.evaluate(() => window.ridgeway.app.flight.flown);
  assert.match(await flight(), / --max-acceleration 0\.5$/);
  assert.ok(parseFloat((await text_of(page, "#clock")).split("of")[1]) > parseFloat(before.split("of")[1]), "it is as quick");
  assert.match(new URL(page.url()).hash, /acceleration=0\.5/);
  await set("acceleration", "0");
  await page.evaluate(() => window.ridgeway.app.flight.flown);
  assert.match(await text_of(page, "#no-flight"), /^Acceleration '0': /);
  await set("acceleration", "2");
  await planned(page, () => set("alternatives", "3"));
  assert.match(await flight(), /^ridgeway trajectory rooms\.ridge --path route\.csv --radius 0\.3 --max-speed 2/);
  await planned(page, () => set("alternatives", "1"));
  const [saved] = await Promise.all([page.waitForEvent("download"), page.click("#save-route")]);
  assert.equal(saved.suggestedFilename(), "route.csv");
  const lines = (await fs.readFile(await saved.path(), "utf8")).trim().split("\n");
  const waypoints = await page.evaluate(() => window.ridgeway.app.query.shown[0].waypoints);
  assert.deepEqual([lines[0], ...lines.slice(1).map((line) => line.split(",").map(Number))], ["x,y,z", ...waypoints]);
});

test("the command gives the same answer, also where the form is left as it is", async () => {
  await planned(page, () => set("radius", ""));
  assert.match(await page.locator("#command").textContent(), / --radius 0\.3 --snap 0\.5$/);
  await planned(page, () => set("alternatives", "3"));
  await planned(page, () => page.selectOption("#planner", "esdf"));
  assert.ok(await page.locator("#alternatives").isDisabled(), "A* on voxels has no other routes");
  assert.doesNotMatch(await page.locator("#command").textContent(), /--alternatives/);
  await planned(page, () => page.selectOption("#planner", "graph"));
  assert.ok(await page.locator("#alternatives").isEnabled());
  assert.match(await page.locator("#command").textContent(), / --alternatives 3$/);
  await planned(page, () => set("alternatives", "1"));
  await planned(page, () => set("radius", "0.3"));
});

test("plans with any numbers that planners take, also those between the steps of a field", async () => {
  for (const [id, value] of [["radius", "0.3334"], ["snap", "0.25"], ["prefer", "0.3"]]) await planned(page, () => set(id, value));
  await planned(page, () => page.locator("#go").click());
  assert.equal(await page.locator("#length").count(), 1, await text_of(page, "#result"));
  for (const [id, value] of [["radius", "0.3"], ["snap", "0.5"], ["prefer", "0"]]) await planned(page, () => set(id, value));
});

test("a field that is left by pressing Enter is planned with once", kLimit, async () => {
  const asked = () => page.asked.filter((address) => address.includes("/api/plan")).length;
  await page.fill("#to", "2, -0.9, 1");
  const before = asked();
  await planned(page, () => page.locator("#to").press("Enter"));
  assert.equal(asked(), before + 1);
  await planned(page, () => set("to", "2, -1, 1"));
});

test("where start and goal are one place there is no flight, nor that of before", kLimit, async () => {
  await planned(page, () => set("to", "-2, 1, 1"));
  await page.waitForFunction(() => document.getElementById("no-flight").textContent !== "");
  assert.match(await text_of(page, "#no-flight"), /start and goal are one place/);
  assert.ok(await page.locator("#flight-time").isHidden());
  await planned(page, () => set("to", "2, -1, 1"));
});

test("the flight is that of the speed in the form, in whatever order answers come", kLimit, async () => {
  const flown = () => page.evaluate(() => window.ridgeway.app.flight.flown);
  const slow = await hold(page, "**/api/trajectory*max_speed=0.5&*");
  await set("speed", "0.5");
  await page.evaluate(() => { window.slow_flight = window.ridgeway.app.flight.flown; });
  await slow.asked;
  await set("speed", "4");
  await flown();
  const clock = await text_of(page, "#clock");
  await slow.release();
  await page.evaluate(() => window.slow_flight);
  assert.equal(await text_of(page, "#clock"), clock);
  await set("speed", "0");
  await flown();
  assert.match(await text_of(page, "#no-flight"), /^Speed '0': /);
  assert.ok(await page.locator("#speed").isVisible(), "the speed cannot be mended");
  await set("speed", "2");
  await flown();
  assert.equal(await text_of(page, "#no-flight"), "");
  assert.match(await text_of(page, "#clock"), /^0\.0 of \d/);
});

test("a route whose path is too long for an address is flown by its ends", async () => {
  const before = page.asked.length;
  await page.evaluate(async () => {
    const { flight } = window.ridgeway.app;
    const path = Array.from({ length: 320 }, (_, i) => [-1.9 + 0.001 * i, 1.123, 1.123]);
    flight.fly({ from: "-2,1,1", to: "2,-1,1", radius: "0.3" }, path);
    await flight.flown;
  });
  const [address] = page.asked.slice(before).filter((address) => address.includes("/api/trajectory"));
  assert.match(address, /from=/);
  assert.equal(await text_of(page, "#no-flight"), "");
  await planned(page, () => page.locator("#go").click());
});

test("a drag plans while a trajectory is being made", kLimit, async () => {
  const count = () => page.evaluate(() => Number(document.body.dataset.planned));
  const plans = (before) => page.waitForFunction((before) => Number(document.body.dataset.planned) > before, before, { timeout: 10_000 });
  const flight = await hold(page, "**/api/trajectory*");
  await page.locator("#go").click();
  await flight.asked;
  const at = await page.evaluate(() => { const { app, stage } = window.ridgeway; return stage.on_canvas(app.routes.goal.position); });
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  const before = await count();
  await page.mouse.move(at.x, at.y + 8);
  await plans(before);
  await flight.release();
  await planned(page, () => page.mouse.up());
  assert.ok(await page.locator("#clock").isVisible(), "there is no flight after the drag");
});

test("parts that nothing joins are told, and a map's own radius is planned with, whatever its decimals", async () => {
  const other = await view(rooms({ name: "closed", has_door: false, options: ["--min-clearance", "0.3334"] }));
  const closed = await open(browser, other.address);
  await closed.locator("#layer-narrow").click();
  await closed.evaluate(() => window.ridgeway.app.layers.switched);
  assert.match(await text_of(closed, "#narrow-list"), /^None: there are 2 parts/);
  assert.equal(await closed.inputValue("#radius"), "0.3334");
  await closed.fill("#from", "-2, 1, 1");
  await closed.fill("#to", "-1, -1, 1");
  await planned(closed, () => closed.locator("#go").click());
  assert.equal(await closed.locator("#length").count(), 1, await text_of(closed, "#result"));
  await closed.close();
  await other.stop();
});

test("what is typed before the map is there is planned once it is, and Plan leaves no page", { timeout: 120_000 }, async () => {
  const early = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  const surface = await hold(early, "**/api/surface/coarse"); // without it there is no form that answers
  await early.goto(served.address);
  await surface.asked;
  await early.fill("#from", "(-2, 1, 1)");
  await early.fill("#to", "[2, -1, 1]");
  await early.locator("#go").click();
  await planned(early, surface.release);
  assert.equal(await early.locator("#length").count(), 1, await text_of(early, "#result"));
  assert.equal(new URL(early.url()).search, "");
  await early.close();
});

test("a page that is loaded again, and one that a link leads to, have the question", async () => {
  const first = await open(browser, served.address);
  await first.fill("#from", "-2, 1, 1");
  await first.fill("#radius", "0.32");
  await first.fill("#to", "2, -1, 1");
  await planned(first, () => first.locator("#go").click());
  const length = await text_of(first, "#length");
  const link = first.url();
  await first.close();
  const again = await open(browser, link);
  await again.waitForFunction(() => document.querySelector("#length"), null, { timeout: 30_000 });
  assert.equal(await text_of(again, "#length"), length);
  assert.equal(await again.inputValue("#radius"), "0.32");
  await again.close();
  const other_map = await open(browser, link.replace(/map=[^&]*/, "map=other"));
  assert.equal(await other_map.inputValue("#from"), "");
  await other_map.close();
});

test("a click turns nothing, a drag does: until then the view follows", async () => {
  await page.locator("#top").click();
  const follows = () => page.evaluate(() => { const { stage } = window.ridgeway; const before = stage.camera.top; stage.camera.top *= 2; stage.look_again(); const is_fitted = Math.abs(stage.camera.top - before) < 1e-9; if (!is_fitted) stage.camera.top = before; return is_fitted; });
  const { x, y } = await page.locator("#canvas").boundingBox();
  await page.mouse.click(x + 300, y + 300);
  assert.ok(await follows());
  await page.mouse.move(x + 300, y + 300);
  await page.mouse.down();
  await page.mouse.move(x + 340, y + 320, { steps: 4 });
  await page.mouse.up();
  assert.ok(!(await follows()));
});

test("a drag with Alt goes straight up, and Escape takes it back", async () => {
  await page.locator("#orbit").click();
  await planned(page, () => set("from", "-2, 1, 1"));
  await planned(page, () => set("to", "2, -1, 1"));
  const at = await page.evaluate(() => { const { app, stage } = window.ridgeway; return stage.on_canvas(app.routes.goal.position); });
  const goal = () => page.evaluate(() => window.ridgeway.app.query.goal);
  await page.keyboard.down("Alt");
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x, at.y - 12, { steps: 3 });
  const [gx, gy, gz] = await goal();
  assert.deepEqual([gx, gy], [2, -1]);
  assert.ok(gz > 1.02, `${gz}`);
  await page.keyboard.up("Alt");
  await planned(page, () => page.keyboard.press("Escape"));
  await page.mouse.up();
  assert.deepEqual(await goal(), [2, -1, 1]);
});

test("on a planar map, which has no floor, clicks between its walls are places", async () => {
  const other = await view(rooms({ name: "planar", options: ["--min-clearance", "0.3", "--planar", "0.1,1.5"] }));
  const planar = await open(browser, other.address);
  for (const look of ["#orbit", "#top"]) {
    await planar.locator(look).click();
    await planar.keyboard.press("s");
    const z = await planar.evaluate(() => { const { bounds, voxel_size } = window.ridgeway.app.info; return bounds.min[2] + voxel_size / 2; });
    await click_at(planar, [-2, 0.4, z]);
    const [x, y] = (await planar.inputValue("#from")).split(",").map(Number);
    assert.ok(Math.hypot(x + 2, y - 0.4) < 0.05, `${look}: ${x}, ${y}`);
  }
  await planar.keyboard.press("g");
  await planned(planar, () => click_at(planar, [2, -0.7, 0]));
  assert.equal(await planar.locator("#length").count(), 1, await text_of(planar, "#result"));
  await planar.close();
  await other.stop();
});

test("reasons speak of the form, not of options of the command line", kLimit, async () => {
  await planned(page, () => set("to", "2.95, 1.95, 0.05"));
  await planned(page, () => set("snap", "0.05"));
  assert.match(await text_of(page, "#result"), /larger Snap|a Snap of/);
  assert.doesNotMatch(await text_of(page, "#result"), /--snap/);
});

test("nothing was complained about to the end but what was refused", () => {
  assert.deepEqual(page.complaints.filter((text) => !/status of 400/.test(text)), []);
});

test("where another map is served at the address, the page is loaded again in place of an answer of the other one", kLimit, async () => {
  await planned(page, () => set("to", "2, -1, 1"));
  await served.stop();
  served = await view(map, served.port); // the same again
  await planned(page, () => set("radius", "0.31"));
  assert.equal(await page.locator("#length").count(), 1, await text_of(page, "#result"));
  for (const other of [{ name: "closed", has_door: false }, { name: "closed", options: ["--min-clearance", "0.4"] }]) {
    await served.stop();
    served = await view(rooms(other), served.port);
    const loaded = page.waitForEvent("load");
    await set("radius", "0.45");
    await loaded;
    await page.waitForFunction(() => document.body.dataset.ready === "yes");
    assert.equal(await text_of(page, "#name"), "closed.ridge");
    await set("from", "-2, 1, 1");
    await planned(page, () => set("to", "2, -1, 1"));
    assert.equal(await page.locator("#length").count(), other.has_door === false ? 0 : 1, await text_of(page, "#result"));
  }
});
