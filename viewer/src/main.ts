// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";
import { App } from "./app";
import { element } from "./dom";
import type { Info } from "./layers";
import { read_surface } from "./layers";
import { LivePage } from "./live_page";
import { ask_json, EarlySource, find_source, type MapSource } from "./source";
import { Stage } from "./stage";
import { SurfaceMesh } from "./surface";

/** Pixels: where frames are slow, cells are not drawn finer as long as they are smaller. */
const kSmall = 3;

/** For tests, and for who looks with the console. */
function show_to_tests(parts: object): void {
  Object.assign(window, { ridgeway: { THREE, ...parts } });
}

function is_ready(): void {
  element("loading").textContent = "";
  document.body.dataset.ready = "yes";
}

/** Asked for while the page is still being made. */
const kMapLayers = ["/api/surface/coarse", "/api/graph", "/api/surface"];

/** The map, then all that can be done with it. */
async function begin_map(source: MapSource, stage: Stage, info: Info): Promise<void> {
  if (!info.bounds) throw new Error("nothing is known of this map");
  stage.holds = true;
  const base = new THREE.Vector3(...info.bounds.min);
  const size = new THREE.Vector3(...info.bounds.max).sub(base);
  stage.set_box(new THREE.Vector3(), size);
  const surface = new SurfaceMesh(read_surface(await source.ask("/api/surface/coarse")), base, size.z);
  const asked_fine = source.ask("/api/surface").then(read_surface, (error: Error) => error);
  surface.cut = surface.height_below_ceilings(size.x * size.y);
  stage.scene.add(surface.mesh);
  const is_coarse_enough = () => stage.is_slow && stage.pixels_of(surface.coarse_cell) < kSmall;
  stage.before_frame.push((is_coarse) => surface.draw_coarse(is_coarse || is_coarse_enough()));
  stage.look_from_side();
  const app = new App(source, stage, info, base, surface);
  show_to_tests({ app, stage, surface });
  element("loading").textContent = "";
  await app.layers.load();
  await app.heights.sectioned;
  surface.draw_little(); // the first frame compiles the shaders: the next tells whether frames are slow
  stage.draw();
  surface.cut = surface.cut;
  stage.holds = false;
  const draw_all = () => {
    stage.changed();
    stage.draw();
  };
  draw_all();
  performance.mark("first-frame");
  const fine = await asked_fine;
  if (fine instanceof Error) throw fine;
  surface.refine(fine);
  if (!is_coarse_enough()) draw_all();
  app.query.take_form();
  is_ready();
}

function soon(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, 50));
}

async function begin(): Promise<void> {
  // Until there is a map to plan on, what is typed waits in the form (QueryPanel.take_form).
  element("query").addEventListener("submit", (event) => event.preventDefault());
  try {
    const source = new EarlySource(find_source());
    const asked_info = ask_json<Info>(source, "/api/info").then((info) => {
      if (!info.live) source.begin(...kMapLayers);
      return info;
    });
    asked_info.catch(() => {}); // told below
    await Promise.race([asked_info, soon()]); // a server's answer is there before the stage is, a planner's after
    const stage = new Stage(element<HTMLCanvasElement>("canvas"));
    const info = await asked_info;
    if (!info.live) return await begin_map(source, stage, info);
    element("loading").textContent = "Waiting for the first scan";
    const live = new LivePage(source, stage, (app) => {
      show_to_tests({ app, stage, live, surface: app.surface });
      app.query.take_form();
      is_ready();
    });
  } catch (error) {
    const loading = element("loading");
    loading.textContent = `The map cannot be shown: ${error instanceof Error ? error.message : error}`;
    loading.setAttribute("role", "alert");
    document.body.dataset.ready = "failed";
  }
}

// In a page of one file the script stands before what it works on.
if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", () => void begin());
else void begin();
