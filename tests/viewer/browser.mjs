// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

// Debian's Chromium, with a software WebGL.
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { fileURLToPath } from "node:url";

const require = createRequire(fileURLToPath(new URL("../../viewer/package.json", import.meta.url)));
const { chromium } = require("playwright-core");
export const axe_source = require("axe-core").source;

const program = process.env.RIDGEWAY_CHROMIUM ?? "/usr/bin/chromium";

/** All graphics by software, wherever the tests run; the page is put together by the software WebGL, too. */
const kSoftware = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

/** Skips all tests (77) where there is no Chromium, or its driver. */
export function launch(graphics = kSoftware) {
  if (!existsSync(program)) process.exit(77);
  return chromium.launch({
    executablePath: program,
    headless: true,
    args: [
      "--no-sandbox",
      ...graphics,
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
    ],
  });
}

/** A page that has been loaded, or, without `wait`, is about to be; `complaints` and `asked` grow as it is used. */
export async function open(browser, address, { wait = true, ...options } = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 }, ...options });
  page.complaints = [];
  page.asked = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !/GPU stall|swiftshader|WebGL/i.test(message.text()))
      page.complaints.push(message.text());
  });
  page.on("pageerror", (error) => page.complaints.push(error.message));
  page.on("request", (request) => page.asked.push(request.url()));
  await page.goto(address);
  if (wait) await page.waitForFunction(() => document.body.dataset.ready, null, { timeout: 90_000 });
  return page;
}

export const text_of = (page, selector) => page.locator(selector).innerText();

/** The picture as it stands: the pixels, how many colours they have, and the share that is drawn. */
export async function pixels(page) {
  const { width, height, base64 } = await page.evaluate(() => {
    const { stage } = window.ridgeway;
    stage.draw();
    const gl = stage.renderer.getContext();
    const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    const bytes = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    let text = "";
    for (let i = 0; i < bytes.length; i += 32768) text += String.fromCharCode(...bytes.subarray(i, i + 32768));
    return { width, height, base64: btoa(text) };
  });
  const bytes = Buffer.from(base64, "base64");
  const words = new Uint32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
  const ground = words[0];
  let drawn = 0;
  for (const word of words) if (word !== ground) ++drawn;
  return { width, height, words, colours: new Set(words).size, drawn: drawn / words.length };
}

/** Pixels that differ between two pictures; all of them where the sizes do. */
export function difference(a, b) {
  if (a.words.length !== b.words.length) return Math.max(a.words.length, b.words.length);
  let count = 0;
  for (let i = 0; i < a.words.length; ++i) if (a.words[i] !== b.words[i]) ++count;
  return count;
}

/** Clicks on the canvas where a place of the world is seen. */
export async function click_at(page, place) {
  const at = await page.evaluate((place) => {
    const { app, stage } = window.ridgeway;
    return stage.on_canvas(app.routes.local(place));
  }, place);
  await page.mouse.click(at.x, at.y);
}

/** Acts, and waits until what is planned then has been planned, and the flight along it, if any, is there. */
export async function planned(page, act) {
  const count = () => page.evaluate(() => Number(document.body.dataset.planned ?? 0));
  const before = await count();
  await act();
  await page.waitForFunction((before) => Number(document.body.dataset.planned ?? 0) > before, before, { timeout: 30_000 });
  await page.evaluate(() => window.ridgeway.app.flight.flown);
}

/** Holds up answers to addresses that match, from when they are asked for (`asked`) until `release()`. */
export async function hold(page, pattern) {
  let tell, release;
  const asked = new Promise((resolve) => (tell = resolve));
  const released = new Promise((resolve) => (release = resolve));
  await page.route(pattern, async (route) => {
    const response = await route.fetch();
    tell();
    await released;
    await route.fulfill({ response });
  });
  return {
    asked,
    release: async () => {
      release();
      await page.unroute(pattern, { behavior: "wait" });
    },
  };
}

/** Gives a control of the form another value, as a person does; a box is clicked. */
export const set_control = (page, id, value) =>
  page.evaluate(([id, value]) => {
    const input = document.getElementById(id);
    if (input.type === "checkbox") input.click();
    else {
      input.value = value;
      input.dispatchEvent(new Event("input", { bubbles: true }));
      input.dispatchEvent(new Event("change", { bubbles: true }));
    }
  }, [id, value]);
