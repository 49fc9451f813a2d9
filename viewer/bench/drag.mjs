// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

// What a step of a dragged goal takes in Chromium, from the pointer's event to the picture:
//   node viewer/bench/drag.mjs [--moves N] [--map MAP.ridge | --page MAP.html] [--flag=--CHROMIUM-FLAG]..
// RIDGEWAY_PROGRAM and RIDGEWAY_DATA as in tests/viewer. Without a map it is fr_079, from Ridgeway's
// own server; `--script PAGE.js`: with another script than the program's; `--trace FILE` keeps Chromium's.
// Without a flag Chromium does its graphics as it does for everybody on such a machine: where there is
// no GPU, WebGL by SwiftShader, and the page put together by software of its own. With
// `--flag=--use-angle=swiftshader` that is done by SwiftShader, too, as in the tests.
//
// A step is one move of the pointer by Playwright, the next one a random time after its picture was
// shown. Times are from the event's own timestamp, which the browser gives it when it comes in,
//   handled    until the page hears of it,
//   answer     until the page has the plan,
//   drawn      until the page has given the commands of the picture with its path,
//   submitted  until the frame of the page with that picture goes to Chromium's compositor,
//   shown      until that has put it together and shown it (PipelineReporter in Chromium's trace).
import { writeFileSync } from "node:fs";
import { loadavg } from "node:os";
import { pathToFileURL } from "node:url";
import { parseArgs } from "node:util";
import { launch, open, planned } from "../../tests/viewer/browser.mjs";
import { office, view } from "../../tests/viewer/program.mjs";

const { values: given } = parseArgs({
  options: {
    moves: { type: "string", default: "200" },
    page: { type: "string" },
    script: { type: "string" },
    map: { type: "string" },
    flag: { type: "string", multiple: true, default: [] },
    trace: { type: "string" },
  },
});

const kCategories = ["blink.user_timing", "cc", "benchmark", "viz", "input", "latency", "disabled-by-default-devtools.timeline.frame"];

/** In the page: tells of each step when its event came, was answered and was drawn. */
function watch() {
  const { app, stage } = window.ridgeway;
  let step;
  window.steps = [];
  window.begin_step = (name) => {
    step = { name };
    window.step_drawn = new Promise((drawn) => (step.tell = drawn));
  };
  const note = (event) => {
    if (!step || event.buttons === 0 || step.event !== undefined) return;
    step.event = event.timeStamp;
    step.handled = performance.now();
  };
  for (const type of ["pointerrawupdate", "pointermove"]) addEventListener(type, note, { capture: true });
  const { show_routes } = app.routes;
  app.routes.show_routes = (routes) => {
    show_routes.call(app.routes, routes);
    if (step?.event !== undefined) step.answer ??= performance.now();
  };
  const { draw } = stage;
  stage.draw = () => {
    draw.call(stage);
    if (step?.answer === undefined) return;
    const done = step;
    step = undefined;
    done.drawn = performance.now();
    performance.mark(`begun ${done.name}`, { startTime: done.event });
    performance.mark(`drawn ${done.name}`, { startTime: done.drawn });
    window.steps.push(done);
    requestAnimationFrame(() => setTimeout(done.tell));
  };
}

/** How long the first picture of a drag takes, or the first after it, with the time in which it is drawn, milliseconds. */
function draw_time(is_moving) {
  const { stage } = window.ridgeway;
  const started = performance.now();
  stage.moves_over(is_moving);
  stage.draw();
  return stage.wait_for_picture() - started;
}

/** Frames of the page that were shown: when what is in them was handed over and when they were shown, microseconds of the trace. */
function frames_of(events) {
  const under_way = new Map();
  const frames = [];
  for (const event of [...events].sort((a, b) => a.ts - b.ts)) {
    if (!["PipelineReporter", "Commit", "SubmitCompositorFrameToPresentationCompositorFrame"].includes(event.name)) continue;
    const id = `${event.pid} ${event.id2?.local}`;
    const is_begun = event.ph === "b";
    if (event.name === "PipelineReporter") {
      const frame = under_way.get(id);
      if (frame?.committed && frame.shown) frames.push(frame);
      if (is_begun) under_way.set(id, {});
      else under_way.delete(id);
    } else if (under_way.has(id)) {
      const frame = under_way.get(id);
      if (event.name === "Commit" && is_begun) frame.committed = event.ts;
      if (event.name !== "Commit") frame[is_begun ? "submitted" : "shown"] = event.ts;
    }
  }
  return frames.sort((a, b) => a.committed - b.committed);
}

/** Processor time of each kind of the browser's processes, seconds. */
async function processor_times(session) {
  const times = {};
  for (const { type, cpuTime } of (await session.send("SystemInfo.getProcessInfo")).processInfo) times[type] = (times[type] ?? 0) + cpuTime;
  return times;
}

const sorted = (values) => [...values].sort((a, b) => a - b);
const at_share = (values, share) => sorted(values)[Math.min(values.length - 1, Math.ceil(share * values.length) - 1)];
const row = (name, values) => `${name.padEnd(10)} ${[0.5, 0.9, 0.99, 1].map((share) => at_share(values, share).toFixed(1).padStart(7)).join("")}`;

const served = given.page ? undefined : await view(given.map ?? office());
const browser = await launch(given.flag);
const page = await open(browser, "about:blank", { wait: false });
if (given.script) await page.route("**/page.js", (route) => route.fulfill({ path: given.script }));
await page.goto(given.page ? pathToFileURL(given.page).href : served.address);
await page.waitForFunction(() => document.body.dataset.ready, null, { timeout: 90_000 });
await page.unroute("**/page.js"); // what is asked for later would be held up
await page.fill("#from", "1.3, -2.8, 1.2");
await page.fill("#to", "26, -0.1, 1.3");
await planned(page, () => page.locator("#go").click());
const at = await page.evaluate(() => { const { app, stage } = window.ridgeway; return stage.on_canvas(app.routes.goal.position); });
const ends = [];
for (const is_moving of [true, false]) ends.push(await page.evaluate(draw_time, is_moving));
await page.evaluate(watch);
await page.mouse.move(at.x, at.y);
await page.mouse.down();
await page.mouse.move(at.x + 1, at.y);
await page.waitForTimeout(1000);
await browser.startTracing(page, { categories: kCategories });
const moves = Number(given.moves);
const session = await browser.newBrowserCDPSession();
const before = await processor_times(session);
const load = loadavg()[0];
for (let i = 0; i < moves; ++i) {
  await page.evaluate((name) => window.begin_step(name), i);
  const turn = (2 * Math.PI * i) / 40;
  await page.mouse.move(at.x + 60 * Math.sin(turn), at.y + 12 * Math.sin(2 * turn + 1));
  await page.evaluate(() => window.step_drawn);
  await page.waitForTimeout(60 + 40 * Math.random());
}
const after = await processor_times(session);
await page.waitForTimeout(500); // the last one is shown, too
const steps = await page.evaluate(() => window.steps);
const trace = JSON.parse(await browser.stopTracing());
if (given.trace) writeFileSync(given.trace, JSON.stringify(trace));
await page.mouse.up();
await browser.close();
await served?.stop();

const marks = new Map(trace.traceEvents.filter((event) => /^(begun|drawn) \d+$/.test(event.name)).map((event) => [event.name, event.ts]));
const frames = frames_of(trace.traceEvents);
for (const step of steps) {
  const drawn = marks.get(`drawn ${step.name}`);
  const frame = frames.find(({ committed }) => committed >= drawn);
  step.submitted = step.event + (frame.submitted - marks.get(`begun ${step.name}`)) / 1000;
  step.shown = step.event + (frame.shown - marks.get(`begun ${step.name}`)) / 1000;
}
console.log(`${steps.length} steps, load ${load.toFixed(1)}; milliseconds at 50, 90, 99, 100 %`);
for (const name of ["handled", "answer", "drawn", "submitted", "shown"]) console.log(row(name, steps.map((step) => step[name] - step.event)));
console.log(`the first picture of a drag ${ends[0].toFixed(0)}, the first after it ${ends[1].toFixed(0)}`);
console.log(`processor time a step: ${Object.keys(after).map((type) => `${type} ${((1000 * (after[type] - (before[type] ?? 0))) / moves).toFixed(1)}`).join(", ")}`);
