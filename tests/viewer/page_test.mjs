// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

// The page of `ridgeway view` as a person uses it, in Chromium.
import assert from "node:assert/strict";
import test, { after, before } from "node:test";
import { axe_source, click_at, difference, launch, open, pixels, planned, set_control, text_of } from "./browser.mjs";
import { rooms, run_json, view } from "./program.mjs";

let served, browser, page, map;
before(async () => {
  map = rooms();
  served = await view(map);
  browser = await launch();
  page = await open(browser, served.address);
}, { timeout: 120_000 });
after(async () => {
  await browser?.close();
  await served?.stop();
});

const set = (id, value) => set_control(page, id, value);

async function switch_layer(name) {
  await page.locator(`#layer-${name}`).click();
  await page.evaluate(() => window.ridgeway.app.layers.switched);
}

test("loads without errors, and asks nobody else", () => {
  assert.deepEqual(page.complaints, []);
  assert.ok(page.asked.length > 3);
  for (const address of page.asked) assert.ok(address.startsWith(served.address) || address.startsWith("data:") || address.startsWith("blob:"), address);
});

test("draws the map", async () => {
  const { colours, drawn } = await pixels(page);
  assert.ok(drawn > 0.1, `only ${drawn} of the canvas is drawn`);
  assert.ok(colours > 20, `only ${colours} colours`);
});

test("every layer changes the picture, and can be taken away again", async () => {
  for (const name of ["surface", "slice", "gvd", "diagram", "graph"]) {
    const before = await pixels(page);
    await switch_layer(name);
    const switched = await pixels(page);
    assert.ok(difference(before, switched) > 50, `${name}: ${difference(before, switched)} pixels differ`);
    await switch_layer(name);
    assert.equal(difference(before, await pixels(page)), 0, name);
  }
});

test("asks for components where colours show them, and shows them", async () => {
  const asked = () => page.asked.filter((address) => address.includes("/api/components")).length;
  assert.equal(asked(), 0);
  const before = await pixels(page);
  const colour = async (by) => {
    await page.selectOption("#colour", by);
    await page.evaluate(() => window.ridgeway.app.layers.switched);
  };
  await colour("component");
  assert.equal(asked(), 2); // of the graph, and of the diagram that was shown before
  assert.ok(difference(before, await pixels(page)) > 50);
  assert.match(await text_of(page, "#legend"), /connected component/);
  await colour("clearance");
  assert.equal(difference(before, await pixels(page)), 0);
});

test("what was said of a slice or a cut that could not be had goes once it can", async () => {
  const page = await open(browser, served.address);
  const set = (id, value) => set_control(page, id, value);
  const refused = /api\/(slice|section)/;
  await page.route(refused, (route) => route.fulfill({ status: 500, contentType: "application/json", body: '{"error":"no memory for it"}' }));
  await set("cut", "0.5");
  await set("slice", "1.3");
  await page.waitForFunction(() => document.querySelector("#hint").textContent.includes("no memory"));
  await page.unroute(refused);
  await set("slice", "1.1");
  await page.waitForFunction(() => document.querySelector("#hint").textContent === "");
  // The section is asked for again by itself.
  await page.waitForFunction(() => window.ridgeway.app.heights.section.mesh.visible, null, { timeout: 15_000 });
  await page.close();
});

test("sliders move the cut and the slice", async () => {
  const before = await pixels(page);
  await set("cut", "0.5");
  const cut = await pixels(page);
  assert.ok(difference(before, cut) > 100);
  assert.match(await text_of(page, "#cut-text"), /^0\.4 m$/);
  await set("slice", "1.1");
  await page.waitForTimeout(800);
  const low = await pixels(page);
  assert.ok(difference(cut, low) > 100);
  await set("slice", "1.9");
  await page.waitForTimeout(800);
  assert.ok(difference(low, await pixels(page)) > 100);
  await page.locator("#layer-slice").click();
  await set("cut", "2.2");
});

test("a wall that is cut is one colour, not a way to look below the floor", async () => {
  await page.locator("#top").click();
  const colour = () => page.evaluate(async () => {
    const { app, stage } = window.ridgeway;
    await app.heights.sectioned;
    stage.draw();
    const at = stage.on_canvas(app.routes.local([0.05, 1.25, 1]));
    const gl = stage.renderer.getContext();
    const pixel = new Uint8Array(4);
    const ratio = stage.renderer.getPixelRatio();
    gl.readPixels(Math.floor(at.x * ratio), gl.drawingBufferHeight - 1 - Math.floor(at.y * ratio), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    return [...pixel.subarray(0, 3)];
  });
  for (const cut of ["0.8", "1.65"]) {
    await set("cut", cut);
    assert.deepEqual(await colour(), [0x3a, 0x44, 0x50], `cut at ${cut}`);
  }
  await set("cut", "2.2");
  await page.locator("#orbit").click();
});

test("where a wall is cut clicks do not go through it", async () => {
  await page.locator("#top").click();
  await set("cut", "0.8");
  await page.evaluate(() => window.ridgeway.app.heights.sectioned);
  const before = await page.inputValue("#to");
  await page.locator("[data-tool=goal]").click();
  await click_at(page, [0.05, 1.25, 0.8]);
  assert.match(await text_of(page, "#hint"), /^This is inside an obstacle that is cut/);
  assert.equal(await page.inputValue("#to"), before);
  await page.locator("#orbit").click();
  await page.locator("[data-tool=measure]").click();
  for (const place of [[0.05, 1.25, 0.8], [0.05, -1.25, 0.8]]) await click_at(page, place);
  assert.match(await text_of(page, "#hint"), /^2\.\d+ m: 2\.\d+ m across, (-?0\.0\d*|0) m up/);
  await page.keyboard.press("Escape");
  await set("cut", "2.2");
});

test("clicks on start and goal plan what the command line plans", async () => {
  await page.locator("#top").click();
  await page.locator("[data-tool=start]").click();
  await click_at(page, [-2, 0.4, 0]);
  await planned(page, () => click_at(page, [2, -0.7, 0]));
  const from = await page.inputValue("#from");
  const to = await page.inputValue("#to");
  const [x, y] = from.split(",").map(Number);
  assert.ok(Math.hypot(x + 2, y - 0.4) < 0.1, from);
  const plan = run_json("plan", map, `--from=${from.replaceAll(" ", "")}`, `--to=${to.replaceAll(" ", "")}`);
  assert.equal(plan.status, "ok");
  assert.equal(await text_of(page, "#length"), `${Number(plan.length.toFixed(3))} m`);
  assert.match(await text_of(page, "#result"), /clearance/);
  assert.match(await page.locator("#command").textContent(), /ridgeway plan rooms\.ridge --from=/);
});

test("typed places plan too, and there is a trajectory to fly along", async () => {
  await page.fill("#from", "-2, 1, 1");
  await planned(page, () => page.locator("#from").press("Tab"));
  await page.fill("#to", "2 -1 1");
  await planned(page, () => page.locator("#to").press("Tab"));
  const plan = run_json("plan", map, "--from=-2,1,1", "--to=2,-1,1");
  assert.equal(await text_of(page, "#length"), `${Number(plan.length.toFixed(3))} m`);
  await page.locator("#clock").waitFor({ state: "visible" });
  const before = await pixels(page);
  await set("time", "1.5");
  assert.ok(difference(before, await pixels(page)) > 20, "the drone does not move");
  assert.match(await text_of(page, "#clock"), /^1\.5 of \d/);
  assert.match(await text_of(page, "#state"), /m\/s at/);
});

test("alternatives are those of the command line", async () => {
  await planned(page, () => set("alternatives", "3"));
  const routes = run_json("plan", map, "--from=-2,1,1", "--to=2,-1,1", "--alternatives", "3").routes;
  assert.equal(await page.evaluate(() => window.ridgeway.app.query.shown.length), routes.length);
  await page.locator("#clock").waitFor({ state: "visible" });
  const flown = page.asked.map((address) => new URL(address)).filter((address) => address.pathname === "/api/trajectory").at(-1);
  assert.equal(flown.searchParams.get("path"), routes[0].waypoints.map((p) => p.join(",")).join(";"), "the flight is along another route");
  await planned(page, () => set("alternatives", "1"));
});

test("no route: the reason in words, and the view goes there", async () => {
  await planned(page, () => set("radius", "0.8"));
  assert.match(await text_of(page, "#result"), /too narrow by 0\.\d+ m at .*not connected at a radius of 0.8 m/);
  assert.equal(await page.locator("#length").count(), 0);
  const before = await pixels(page);
  await page.locator("#show-place").click();
  await page.waitForTimeout(1500);
  assert.ok(difference(before, await pixels(page)) > 100);
  const is_marked = () => page.evaluate(() => window.ridgeway.app.routes.narrow.visible);
  assert.ok(await is_marked());
  await planned(page, () => set("radius", "0.3"));
  assert.ok(!await is_marked());
});

test("dragging the goal plans as it moves, and draws the route anew, not the map", async () => {
  await page.locator("#top").click();
  await page.waitForTimeout(600);
  const at = await page.evaluate(() => { const { app, stage } = window.ridgeway; return stage.on_canvas(app.routes.goal.position); });
  const before = await text_of(page, "#length");
  const drawn = () => page.evaluate(() => { const { stage } = window.ridgeway; return { frames: stage.frames, stills: stage.stills }; });
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  const first = await drawn();
  const lengths = new Set();
  for (let i = 1; i <= 6; ++i) {
    await planned(page, () => page.mouse.move(at.x, at.y - 8 * i));
    lengths.add(await text_of(page, "#length"));
  }
  const last = await drawn();
  assert.ok(lengths.size >= 4, `the length was ${[...lengths]} while the goal moved`);
  assert.ok(last.frames >= first.frames + 6, `${last.frames - first.frames} frames`);
  assert.equal(last.stills, first.stills, "the map was drawn anew while the goal moved");
  await planned(page, () => page.mouse.up());
  assert.notEqual(await text_of(page, "#length"), before);
});

test("a step of a drag is one frame: words change with the picture, which hides the page below", async () => {
  const at = await page.evaluate(() => {
    const { app, stage } = window.ridgeway;
    const draw = stage.draw;
    window.steps = [];
    stage.draw = () => {
      const before = document.getElementById("to").value;
      draw.call(stage);
      window.steps.push([before, document.getElementById("to").value]);
    };
    window.end_steps = () => (stage.draw = draw);
    return stage.on_canvas(app.routes.goal.position);
  });
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  for (let i = 1; i <= 4; ++i) await planned(page, () => page.mouse.move(at.x, at.y + 8 * i));
  const steps = await page.evaluate(() => window.steps.filter(([before, after]) => before !== after));
  assert.equal(steps.length, 4, "the goal in the form changed without a frame");
  await planned(page, () => page.mouse.up());
  await page.evaluate(() => window.end_steps());
  const goal = (await page.inputValue("#to")).split(",").map(Number);
  assert.deepEqual(goal, await page.evaluate(() => [...window.ridgeway.app.query.goal]));
  assert.equal(await page.evaluate(() => window.ridgeway.stage.renderer.getContext().getContextAttributes().alpha), false);
});

test("where frames are slow, a drag is of fewer pixels, for which the map is not drawn anew, nor after it", async () => {
  const state = () => page.evaluate(() => { const { stage } = window.ridgeway; return { stills: stage.stills, width: stage.renderer.getContext().drawingBufferWidth }; });
  const settled = () => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  const set_frame_time = (time) => page.evaluate((time) => Object.assign(window.ridgeway.stage, { frame_time: time }), time);
  const at = await page.evaluate(() => { const { app, stage } = window.ridgeway; return stage.on_canvas(app.routes.goal.position); });
  const whole = await pixels(page);
  const first = await state();
  await set_frame_time(1000);
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await settled();
  const begun = await state();
  const few = await pixels(page);
  await planned(page, () => page.mouse.move(at.x, at.y + 4));
  await planned(page, () => page.mouse.up());
  await settled();
  const ended = await state();
  await set_frame_time(0);
  assert.deepEqual([begun.width, ended.width], [first.width / 2, first.width]);
  assert.deepEqual([begun.stills, ended.stills], [first.stills, first.stills]);
  assert.ok(Math.abs(few.drawn - whole.drawn) < 0.02, `${few.drawn} of the canvas is drawn, not ${whole.drawn}`);
});

test("no line is an instance: software draws those one by one", async () => {
  const instances = await page.evaluate(() => {
    const { stage } = window.ridgeway;
    let lines = 0, instances = 0;
    for (const scene of [stage.scene, stage.overlay])
      scene.traverse(({ isLineSegments2, geometry }) => {
        lines += Boolean(isLineSegments2 && geometry.getAttribute("instanceStart"));
        instances += Boolean(geometry?.isInstancedBufferGeometry && geometry.getAttribute("instanceStart"));
      });
    return { lines, instances };
  });
  assert.ok(instances.lines >= 5, `${instances.lines} layers of lines`); // graph, route and flight, what is hidden of these two
  assert.equal(instances.instances, 0);
});

test("what moves over the map is hidden by it as if all were drawn at once", async () => {
  await planned(page, () => set("alternatives", "1"));
  await page.locator("#orbit").click();
  await page.waitForTimeout(600);
  const over = await pixels(page);
  const at_once = await page.evaluate(() => {
    const { stage } = window.ridgeway;
    stage.scene.add(...[...stage.overlay.children].filter((part) => !part.isLight));
    stage.changed();
  }).then(() => pixels(page));
  await page.evaluate(() => {
    const { app, stage } = window.ridgeway;
    stage.overlay.add(app.routes.start, app.routes.goal, app.routes.paths, app.routes.flight_group);
    stage.changed();
  });
  // Depths go through a texture, which rounds: a line's edge may be on the other side of a wall.
  assert.ok(difference(over, at_once) < 1e-4 * over.words.length, `${difference(over, at_once)} pixels differ`);
});

test("marks are of the robot's size, and can be seen from afar", async () => {
  const marks = (farther) => page.evaluate((farther) => {
    const { app, stage } = window.ridgeway;
    stage.turn(0, 0, farther);
    stage.draw();
    return [app.routes.goal.scale.x, stage.css_pixels_of(app.routes.goal.scale.x)];
  }, farther);
  assert.equal((await marks(1))[0], 0.3);
  await page.evaluate(() => window.ridgeway.app.routes.set_radius(0.1));
  const [, pixels] = await marks(50);
  assert.ok(Math.abs(pixels - 5) < 1e-6, `${pixels} pixels`);
  const drawn = await page.evaluate(() => window.ridgeway.stage.css_pixels_of(1));
  assert.ok(drawn > 1, "the view goes so far off that nothing is drawn");
  assert.equal((await marks(1 / 8))[0], 0.1);
  await page.evaluate(() => { const { app, stage } = window.ridgeway; app.routes.set_radius(0.3); stage.look_from_side(); });
});

test("ceilings are cut off, and nothing where there are none", async () => {
  const cuts = await page.evaluate(() => {
    const { THREE, surface } = window.ridgeway;
    /** Of 20 x 20 cells a floor, or none, and what looks down at two heights, so many cells across. */
    const cut = (sides, has_floor = true) => {
      const faces = [...(has_floor ? [[0, 0, 0, 5, 20, 20]] : []), ...sides.map((side, i) => [0, 0, 20 + 10 * i, 4, side, side])];
      const cells = new Uint16Array(faces.flatMap((face) => face.slice(0, 4)));
      const sizes = new Uint8Array(faces.flatMap(([, , , , width, height]) => [width, height, 0, 0]));
      const made = new surface.constructor({ origin: [0, 0, 0], cell: 0.1, cell_voxels: 1, count: faces.length, cells, sizes }, new THREE.Vector3(), 4);
      return made.height_below_ceilings(2 * 2);
    };
    return [cut([0, 20]), cut([4, 5]), cut([0, 0]), cut([0, 5], false), cut([20], false)];
  });
  assert.ok(Math.abs(cuts[0] - 2.9) < 1e-9, String(cuts));
  assert.deepEqual(cuts.slice(1), [4, 4, 4, 4]);
});

test("measures what is clicked", async () => {
  await page.locator("#top").click();
  await page.keyboard.press("m");
  await click_at(page, [-2.5, -1.5, 0]);
  await click_at(page, [-0.5, -1.5, 0]);
  const hint = await text_of(page, "#hint");
  assert.ok(Math.abs(Number(/^([\d.]+) m/.exec(hint)[1]) - 2) < 0.05, hint);
  // Where the start is marked, too.
  const [x, y, z] = (await page.inputValue("#from")).split(",").map(Number);
  await click_at(page, [x, y, z]);
  await click_at(page, [x + 0.5, y, 0]);
  assert.notEqual(await text_of(page, "#hint"), hint);
  assert.match(await text_of(page, "#hint"), /^[\d.]+ m: /);
  await page.keyboard.press("Escape");
});

/** Waits until the view is still: while it moves there may be fewer pixels. */
const still = () => page.waitForFunction(() => !window.ridgeway.stage.coarse);

test("the picture is there again after the graphics card has lost it", async () => {
  await still();
  const before = await pixels(page);
  await page.evaluate(() => new Promise((resolve) => {
    const canvas = document.getElementById("canvas");
    const card = window.ridgeway.stage.renderer.getContext().getExtension("WEBGL_lose_context");
    canvas.addEventListener("webglcontextlost", () => setTimeout(() => card.restoreContext()), { once: true });
    canvas.addEventListener("webglcontextrestored", () => requestAnimationFrame(() => resolve()), { once: true });
    card.loseContext();
  }));
  assert.equal(difference(before, await pixels(page)), 0);
});

test("keys choose tools, with Shift and after a click on a layer too, and not with Alt", async () => {
  const is_chosen = () => page.getAttribute("[data-tool=start]", "aria-pressed");
  await page.locator("#layer-routes").focus();
  await page.keyboard.press("Alt+s");
  assert.equal(await is_chosen(), "false");
  await page.keyboard.press("Shift+S");
  assert.equal(await is_chosen(), "true");
  await page.keyboard.press("Escape");
  assert.equal(await is_chosen(), "false");
  await page.locator("#radius").focus();
  await page.keyboard.press("s");
  assert.equal(await is_chosen(), "false");
});

test("keys turn the view, from the side and from above", async () => {
  await page.locator("#canvas").focus();
  await page.keyboard.press("o");
  await still();
  let before = await pixels(page);
  for (const key of ["ArrowLeft", "ArrowUp", "+", "t", "ArrowLeft", "ArrowUp", "+"]) {
    await page.keyboard.press(key);
    await still();
    const now = await pixels(page);
    assert.ok(difference(before, now) > 100, key);
    before = now;
  }
});

test("narrow places are listed, or that there are none", async () => {
  await switch_layer("narrow");
  assert.match(await text_of(page, "#narrow-list"), /None: all places|radius/);
});

test("on a small screen hints and tools do not cover each other, and the legend leaves room for both", async () => {
  await page.setViewportSize({ width: 320, height: 568 });
  await page.locator("[data-tool=start]").click();
  await page.evaluate(() => { document.getElementById("legend-box").open = true; });
  const [tools, hint, legend] = await Promise.all(["#tools", "#hint", "#legend-box"].map((part) => page.locator(part).boundingBox()));
  assert.ok(hint.y >= tools.y + tools.height, `tools end at ${tools.y + tools.height}, the hint begins at ${hint.y}`);
  assert.ok(legend.y >= hint.y + hint.height, `the hint ends at ${hint.y + hint.height}, the legend begins at ${legend.y}`);
  await page.keyboard.press("Escape");
});

test("on a small screen what a plan has found comes into sight", async () => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.evaluate(() => document.getElementById("panel").scrollTo(0, 0));
  await planned(page, () => page.evaluate(() => void window.ridgeway.app.query.plan()));
  const result = await page.locator("#result").boundingBox();
  assert.ok(result.y >= 0 && result.y + result.height <= 844, `from ${result.y}, ${result.height} high`);
});

test("axe finds nothing serious, light and dark, wide and narrow", async () => {
  for (const colorScheme of ["light", "dark"])
    for (const [width, height] of [[1280, 720], [820, 1180], [700, 900], [320, 568]]) {
      await page.emulateMedia({ colorScheme });
      await page.setViewportSize({ width, height });
      await page.evaluate(axe_source);
      const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
      const serious = violations.filter((v) => v.impact === "serious" || v.impact === "critical");
      assert.deepEqual(serious.map((v) => `${v.id}: ${v.nodes.map((n) => n.target).join(" ")}`), [], `${colorScheme} ${width}`);
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "it is wider than the window");
    }
});

test("nothing was complained about to the end", () => assert.deepEqual(page.complaints, []));
