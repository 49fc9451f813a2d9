// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

// Runs that are followed by the page: a recording that is still written to, and an exploration.
import assert from "node:assert/strict";
import { appendFileSync, copyFileSync, existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import net from "node:net";
import { join } from "node:path";
import test, { after, before } from "node:test";
import { axe_source, difference, hold, launch, open, pixels, planned, text_of } from "./browser.mjs";
import { data, folder, follow, run, run_json } from "./program.mjs";

const recording = join(data, "house_depth");
const scans = 10;
const growing = join(folder, "growing");
const map = join(folder, "live.ridge");
const options = ["--voxel-size", "0.2", "--min-clearance", "0.3", "--max-distance", "2"];
const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** The lines of a recording's list, without comments. */
const lines_of = (list) => readFileSync(join(recording, list), "utf8").split("\n").filter((line) => line && !line.startsWith("#"));

/** Adds one scan more to the recording that grows. */
let written = 0;
function write_scan() {
  const image = lines_of("depth.txt")[written].split(" ")[1];
  copyFileSync(join(recording, image), join(growing, image));
  for (const list of ["groundtruth.txt", "depth.txt"]) appendFileSync(join(growing, list), `${lines_of(list)[written]}\n`);
  ++written;
}

/** What a stream says, event by event, to who reads it. */
async function read_events(address, on_event, signal) {
  const response = await fetch(`${address}api/live`, { signal });
  assert.equal(response.status, 200);
  assert.match(response.headers.get("content-type"), /^text\/event-stream/);
  let text = "";
  for await (const part of response.body.pipeThrough(new TextDecoderStream())) {
    text += part;
    for (let end = text.indexOf("\n\n"); end >= 0; end = text.indexOf("\n\n")) {
      const event = text.slice(0, end);
      text = text.slice(end + 2);
      if (event.startsWith("data: ") && on_event(JSON.parse(event.slice(6))) === false) return;
    }
  }
}

let followed, browser, page;
before(async () => {
  mkdirSync(join(growing, "depth"), { recursive: true });
  copyFileSync(join(recording, "camera-intrinsics.txt"), join(growing, "camera-intrinsics.txt"));
  for (const list of ["depth.txt", "groundtruth.txt"]) writeFileSync(join(growing, list), "");
  browser = await launch();
  followed = await follow("live", growing, "-o", map, ...options, "--follow", "60", "--until", `${String(scans - 1).padStart(6, "0")}.png`, "--view");
  page = await open(browser, followed.address, { wait: false });
}, { timeout: 120_000 });
after(async () => {
  await browser?.close();
  await followed?.stop();
});

const shown_scan = (scan) => page.waitForFunction((scan) => Number(document.body.dataset.scan ?? 0) >= scan, scan, { timeout: 60_000 });

test("waits for the first scan, and answers for nothing before it", async () => {
  await page.waitForFunction(() => document.getElementById("live").textContent.startsWith("Waiting"));
  assert.equal(await page.evaluate(() => document.body.dataset.ready), undefined);
  const response = await fetch(`${followed.address}api/plan?from=0,0,1&to=1,1,1`);
  assert.equal(response.status, 503);
  assert.match((await response.json()).error, /nothing is known yet/);
});

test("the map grows in the page, scan by scan", async () => {
  let last;
  for (let scan = 1; scan <= 4; ++scan) {
    write_scan();
    await shown_scan(scan);
    const now = await pixels(page);
    assert.ok(now.drawn > 0.02, `only ${now.drawn} of the canvas is drawn`);
    if (last) assert.ok(difference(last, now) > 200, `scan ${scan}: ${difference(last, now)} pixels differ`);
    last = now;
    assert.match(await text_of(page, "#live"), new RegExp(`^Live: scan ${scan}, [\\d.]+ m³ mapped`));
  }
  assert.deepEqual(page.complaints, []);
});

test("plans by click on the newest map, and again when it has changed", async () => {
  const [from, to] = await page.evaluate(() => {
    const { voxels } = [...window.ridgeway.live.graph.edges.values()][0];
    return [voxels.slice(0, 3), voxels.slice(3)].map((end) => end.map((v) => ((v + 0.5) * 0.2).toFixed(3)).join(", "));
  });
  await page.fill("#from", from);
  await page.fill("#to", to);
  await planned(page, () => page.locator("#go").click());
  assert.equal(await page.locator("#length").count(), 1, await text_of(page, "#result"));
  // What is asked for is asked for again, of the newest map.
  await page.locator("#layer-diagram").click();
  await page.evaluate(() => window.ridgeway.app.layers.switched);
  const asked = () => page.asked.filter((address) => address.endsWith("/api/diagram")).length;
  const before = asked();
  await planned(page, write_scan);
  await shown_scan(5);
  for (let i = 0; i < 100 && asked() === before; ++i) await sleep(100);
  assert.ok(asked() > before, "the diagram is that of an older map");
  assert.deepEqual(page.complaints, []);
});

test("two pages see the same, also one that comes later, and one that leaves disturbs nobody", async () => {
  const late = await open(browser, followed.address);
  await late.waitForFunction(() => Number(document.body.dataset.scan ?? 0) >= 5);
  const counts = (which) => which.evaluate(() => { const { live } = window.ridgeway; return [live.graph.vertices.size, live.graph.edges.size]; });
  assert.deepEqual(await counts(late), await counts(page));
  assert.deepEqual(late.complaints, []);
  await late.close();
});

test("the reason why there is no route stays when the map has changed", async () => {
  await page.fill("#radius", "0.9");
  await planned(page, () => page.locator("#go").click());
  const told = () => text_of(page, "#result");
  const reason = await told();
  assert.match(reason, /nearest obstacle|does not know/);
  await planned(page, write_scan);
  await shown_scan(6);
  assert.match(await told(), /nearest obstacle|does not know/);
  await page.fill("#radius", "0.3");
  await planned(page, () => page.locator("#go").click());
});

test("who is slow holds up nobody, and gets the newest", async () => {
  const socket = net.connect(followed.port, "127.0.0.1");
  socket.pause().write(`GET /api/live HTTP/1.1\r\nHost: 127.0.0.1:${followed.port}\r\n\r\n`);
  socket.on("error", () => {});
  write_scan();
  await shown_scan(7);
  socket.destroy();
});

test("a layer that was asked for before the newest scan is asked for again, though no other scan comes", { timeout: 120_000 }, async () => {
  const asked = () => page.asked.filter((address) => address.endsWith("/api/diagram")).length;
  const settled = () => page.waitForFunction(() => !window.ridgeway.app.layers.renewing);
  await settled();
  const diagram = await hold(page, "**/api/diagram");
  write_scan();
  await diagram.asked;
  await shown_scan(8);
  // As another scan does while the answer is on its way; one that is written may still go into the same.
  const before = asked();
  await page.evaluate(() => void window.ridgeway.app.layers.renew());
  await diagram.release();
  await settled();
  assert.ok(asked() > before, "the diagram stays that of an older map");
});

test("a page that cannot be seen does not follow, and has it all when it is seen again", async () => {
  const see = (is_seen) => page.evaluate((is_seen) => {
    Object.defineProperty(document, "hidden", { value: !is_seen, configurable: true });
    document.dispatchEvent(new Event("visibilitychange"));
  }, is_seen);
  const followed_again = () => page.asked.filter((address) => address.endsWith("/api/live")).length;
  const before = followed_again();
  await see(false);
  const other = await open(browser, followed.address);
  write_scan();
  await other.waitForFunction(() => Number(document.body.dataset.scan ?? 0) >= 9);
  await other.close();
  assert.equal(await page.evaluate(() => document.body.dataset.scan), "8");
  await see(true);
  await shown_scan(9);
  assert.equal(followed_again(), before + 1);
});

test("refuses other sites, and more followers than there is room for", async () => {
  const foreign = await fetch(`${followed.address}api/live`, { headers: { Origin: "http://evil.example" } });
  assert.equal(foreign.status, 403);
  const many = [];
  const answers = [];
  // Rooms of pages that have left are free once the server has noticed, seconds later.
  for (let refused = 0; refused < 6; ) {
    many.push(new AbortController());
    answers.push(await fetch(`${followed.address}api/live`, { signal: many.at(-1).signal }));
    refused = answers.at(-1).status === 503 ? refused + 1 : 0;
    if (refused) await sleep(1000);
  }
  const statuses = answers.map((answer) => answer.status);
  assert.ok(statuses.includes(503) && statuses.includes(200), String(statuses));
  // A page for which there is no room says so, and tries again.
  const late = await open(browser, followed.address, { wait: false });
  await late.waitForFunction(() => /as many pages as can/.test(document.getElementById("live").textContent), null, { timeout: 60_000 });
  let is_refused = true;
  await late.route("**/api/info", (route) => (is_refused ? route.abort() : route.continue()));
  for (const one of many) one.abort();
  // Node closes a stream of its own accord once nothing refers to the answer any more.
  assert.equal(answers.length, many.length);
  await late.waitForFunction(() => /cannot be shown yet/.test(document.getElementById("live").textContent), null, { timeout: 60_000 });
  is_refused = false;
  await late.waitForFunction(() => document.body.dataset.ready === "yes", null, { timeout: 60_000 });
  await late.close();
  assert.equal((await fetch(`${followed.address}api/info`)).status, 200);
});

test("in the end the page has the map that was written, and goes on planning in it", async () => {
  assert.ok(!existsSync(map));
  write_scan();
  await page.waitForFunction(() => document.body.dataset.done, null, { timeout: 60_000 });
  assert.match(await text_of(page, "#live"), new RegExp(`^Done: scan ${scans}, `));
  const { graph } = run_json("info", map);
  const sizes = await page.evaluate(() => { const { live } = window.ridgeway; return [live.graph.vertices.size, live.graph.edges.size]; });
  assert.deepEqual(sizes, [graph.vertices, graph.edges]);
  // The surface is that of the written map, face by face.
  const area = await page.evaluate(async () => {
    const { app, surface } = window.ridgeway;
    const area = (sizes) => { let sum = 0; for (let i = 0; i < sizes.length; i += 4) sum += sizes[i] * sizes[i + 1]; return sum; };
    const bytes = await app.source.ask("/api/surface");
    const count = new Uint32Array(bytes, 32, 1)[0];
    return [area(surface.fine.surface.sizes), area(new Uint8Array(bytes, 40 + 8 * count))];
  });
  assert.equal(area[0], area[1]);
  await planned(page, () => page.locator("#go").click());
  assert.equal(await page.locator("#length").count(), 1, await text_of(page, "#result"));
  assert.deepEqual(page.complaints, []);
  for (const address of page.asked) assert.ok(address.startsWith(followed.address) || address.startsWith("data:") || address.startsWith("blob:"), address);
});

/** Applies an event's surface to blocks by their names. */
function apply_surface(blocks, base64) {
  const bytes = Buffer.from(base64, "base64");
  let at = 36;
  for (let count = bytes.readUInt32LE(32); count > 0; --count) {
    const name = [0, 4, 8].map((k) => bytes.readInt32LE(at + k)).join();
    const quads = bytes.readUInt32LE(at + 12);
    const block = bytes.subarray(at + 16, at + 16 + 4 * quads).toString("hex");
    if (quads > 0) blocks.set(name, block);
    else assert.ok(blocks.delete(name), `${name} was not there`);
    at += 16 + 4 * quads;
  }
  assert.equal(at, bytes.length);
}

test("axe finds nothing serious in a page that follows", async () => {
  await page.evaluate(axe_source);
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  const serious = violations.filter((v) => v.impact === "serious" || v.impact === "critical");
  assert.deepEqual(serious.map((v) => `${v.id}: ${v.nodes.map((n) => n.target).join(" ")}`), []);
});

test("what has been sent adds up to the map, whatever was skipped", async () => {
  const other = await follow("live", recording, "-o", join(folder, "other.ridge"), ...options, "--view");
  const events = [];
  await read_events(other.address, (event) => {
    events.push(event);
    return !event.is_last;
  });
  let whole;
  await read_events(other.address, (event) => {
    whole = event;
    return false;
  });
  await other.stop();
  assert.equal(events[0].begins && whole.begins && whole.is_last, true);
  for (const event of events.slice(1)) assert.equal(event.begins, false);
  assert.deepEqual(events.flatMap((event) => event.positions), whole.positions);
  const [sum, all] = [new Map(), new Map()];
  for (const event of events) if (event.surface) apply_surface(sum, event.surface);
  apply_surface(all, whole.surface);
  assert.ok(all.size > 100);
  assert.deepEqual([...sum].sort(), [...all].sort());
  const { graph } = run_json("info", join(folder, "other.ridge"));
  assert.deepEqual([whole.vertices, whole.edges], [graph.vertices, graph.edges]);
});

test("an exploration shows where the drone flies next", async () => {
  const world = join(folder, "room.yaml");
  const planes = [[[0, 0, 0], [1, 0, 0]], [[5, 0, 0], [-1, 0, 0]], [[0, 0, 0], [0, 1, 0]], [[0, 4, 0], [0, -1, 0]], [[0, 0, 0], [0, 0, 1]], [[0, 0, 2.4], [0, 0, -1]]];
  writeFileSync(world, `name: room\nplanes:\n${planes.map(([point, normal]) => `  - {point: [${point}], normal: [${normal}]}\n`).join("")}`);
  const explored = await follow("explore", world, "-o", join(folder, "room.ridge"), "--start", "1.3,1.3,1.2", "--width", "80", "--radius", "0.2", "--max-distance", "2", "--view");
  const events = [];
  await read_events(explored.address, (event) => {
    events.push(event);
    return !event.is_last;
  });
  await explored.stop();
  assert.ok(events.some((event) => event.ahead.length > 2), "no event has a trajectory");
  assert.ok(events.at(-1).mapped > 30, `${events.at(-1).mapped} m3`);
});

test("where another run answers at the address, the page begins anew", async () => {
  const short = join(folder, "short");
  mkdirSync(join(short, "depth"), { recursive: true });
  copyFileSync(join(recording, "camera-intrinsics.txt"), join(short, "camera-intrinsics.txt"));
  copyFileSync(join(recording, lines_of("depth.txt")[0].split(" ")[1]), join(short, lines_of("depth.txt")[0].split(" ")[1]));
  for (const list of ["depth.txt", "groundtruth.txt"]) writeFileSync(join(short, list), `${lines_of(list)[0]}\n`);
  const run_at = (port) => follow("live", short, "-o", join(folder, "short.ridge"), "--voxel-size", "0.2", "--min-clearance", "0.3", "--max-distance", "2", "--follow", "60", "--view", "--port", String(port));
  const first = await run_at(0);
  const reader = await open(browser, first.address);
  await first.stop();
  const loaded = reader.waitForEvent("load", { timeout: 60_000 });
  const second = await run_at(first.port);
  await loaded;
  await reader.waitForFunction(() => document.body.dataset.ready === "yes", null, { timeout: 60_000 });
  await reader.close();
  await second.stop();
});

test("says which port cannot be had, and what belongs together", () => {
  const taken = run("live", recording, "-o", join(folder, "taken.ridge"), "--view", "--port", String(followed.port));
  assert.equal(taken.status, 1);
  assert.match(taken.stderr, /--port \d+: cannot be had/);
  const alone = run("live", recording, "-o", join(folder, "taken.ridge"), "--port", "0");
  assert.equal(alone.status, 1);
  assert.match(alone.stderr, /--port: is of a page.*--view/);
});

test("ends by Ctrl-C in the middle of a run, with a page connected", async () => {
  const other = await follow("live", join(folder, "nothing-yet"), "-o", join(folder, "none.ridge"), "--follow", "60", "--view");
  const stop = new AbortController();
  const reading = read_events(other.address, () => true, stop.signal).catch(() => {});
  await sleep(300);
  const { code } = await other.stop();
  assert.equal(code, 130);
  stop.abort();
  await reading;
});
