// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";
import { App } from "./app";
import { ask_json, find_source } from "./source";
import type { Info } from "./layers";
import { read_surface } from "./layers";
import { Stage } from "./stage";
import { SurfaceMesh } from "./surface";

/** The map, then all that can be done with it. */
async function begin(): Promise<void> {
  const loading = document.getElementById("loading")!;
  try {
    const source = find_source();
    const stage = new Stage(document.getElementById("canvas") as HTMLCanvasElement);
    const info = await ask_json<Info>(source, "/api/info");
    if (!info.bounds) throw new Error("nothing is known of this map");
    const base = new THREE.Vector3(...info.bounds.min);
    const size = new THREE.Vector3(...info.bounds.max).sub(base);
    stage.set_size(size);
    const surface = new SurfaceMesh(read_surface(await source.ask("/api/surface/coarse")), base, size.z);
    surface.cut = surface.height_below_ceilings();
    stage.scene.add(surface.mesh);
    stage.before_frame.push((is_coarse) => surface.draw_coarse(is_coarse));
    stage.look_from_side();
    const app = new App(source, stage, info, base, surface);
    // For tests, and for who looks with the console.
    Object.assign(window, { ridgeway: { app, stage, surface, THREE } });
    loading.textContent = "";
    stage.draw();
    performance.mark("first-frame");
    surface.refine(read_surface(await source.ask("/api/surface")));
    await app.load_layers();
    stage.draw();
    document.body.dataset.ready = "yes";
  } catch (error) {
    loading.textContent = `The map cannot be shown: ${error instanceof Error ? error.message : error}`;
    loading.setAttribute("role", "alert");
    document.body.dataset.ready = "failed";
  }
}

// In a page of one file the script stands before what it works on.
if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", () => void begin());
else void begin();
