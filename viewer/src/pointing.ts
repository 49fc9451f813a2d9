// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";
import { kMeasure } from "./colours";
import { element, input } from "./dom";
import { ball, dispose, LabelLayer, PathDrawing } from "./drawings";
import type { Vector } from "./layers";
import { metres } from "./numbers";
import type { Page } from "./page";
import type { QueryPanel } from "./query";
import type { Hit } from "./surface";

export type Tool = "look" | "start" | "goal" | "measure";

/** Pixels from a click, nearest first. */
const kAround = [0, 3, 6].flatMap((radius) => (radius === 0 ? [0] : [0, 1, 2, 3, 4, 5, 6, 7]).map((k) => ({ x: radius * Math.cos((k * Math.PI) / 4), y: radius * Math.sin((k * Math.PI) / 4) })));

/** The place above or below another that a ray comes nearest to. */
function nearest_upright(ray: THREE.Ray, place: THREE.Vector3): THREE.Vector3 | null {
  const { origin, direction } = ray;
  const slant = 1 - direction.z * direction.z;
  if (slant < 1e-6) return null; // looked at along the line
  const from = place.clone().sub(origin);
  const up = (direction.z * direction.dot(from) - from.z) / slant;
  return new THREE.Vector3(place.x, place.y, place.z + up);
}

const kHints: Record<Tool, string> = { look: "", start: "Click where the route starts", goal: "Click where the route ends", measure: "Click two places" };

const kSecond = "Click the second place";

/** Clicks on the map, and ends of the route that are dragged. */
export class Pointing {
  private readonly labels = new LabelLayer(element("labels"));
  private readonly measured = new THREE.Group();
  private tool: Tool = "look";
  private measure_from?: THREE.Vector3;
  private down?: { pointer: number; x: number; y: number };
  private dragged?: { pointer: number; which: "start" | "goal"; from: Vector; place: (ray: THREE.Ray) => THREE.Vector3 | null };

  constructor(private readonly page: Page, private readonly query: QueryPanel) {
    const { stage, routes } = page;
    stage.overlay.add(this.measured);
    stage.before_frame.push(() => this.labels.place((p) => stage.on_canvas(p)));
    for (const button of document.querySelectorAll<HTMLButtonElement>("[data-tool]"))
      button.addEventListener("click", () => this.use(button.dataset.tool as Tool));
    const canvas = element("canvas");
    for (const kind of ["pointerdown", "change"]) document.addEventListener(kind, () => this.forget_hint(), { capture: true });
    canvas.addEventListener("pointerdown", (event) => {
      // A second finger moves the view: neither is a click then.
      this.down = event.isPrimary ? { pointer: event.pointerId, x: event.offsetX, y: event.offsetY } : undefined;
      if (!this.down) return;
      const which = event.button === 0 && this.tool !== "measure" ? routes.marker_at(event.offsetX, event.offsetY) : undefined;
      if (which) this.begin_drag(which, event);
    }, { capture: true });
    canvas.addEventListener("pointermove", (event) => {
      if (this.dragged?.pointer === event.pointerId) this.drag(event);
      else if (!this.dragged && event.buttons === 0) canvas.style.cursor = this.tool !== "measure" && routes.marker_at(event.offsetX, event.offsetY) ? "grab" : this.tool === "look" ? "" : "crosshair";
    });
    canvas.addEventListener("pointerup", (event) => {
      if (this.dragged?.pointer === event.pointerId) return this.end_drag();
      const { down } = this;
      if (down?.pointer === event.pointerId && event.button === 0 && Math.hypot(event.offsetX - down.x, event.offsetY - down.y) < 5) this.click(event.offsetX, event.offsetY);
    });
    canvas.addEventListener("pointercancel", (event) => this.dragged?.pointer === event.pointerId && this.end_drag());
  }

  use(tool: Tool): void {
    this.tool = tool;
    this.measure_from = undefined;
    for (const button of document.querySelectorAll<HTMLButtonElement>("[data-tool]")) button.setAttribute("aria-pressed", String(button.dataset.tool === tool));
    this.page.hint(kHints[tool]);
  }

  /** What was said of the last action is not of the next one. */
  private forget_hint(): void {
    this.page.hint(this.measure_from ? kSecond : kHints[this.tool]);
  }

  clear_measured(): void {
    dispose(this.measured);
    this.measured.clear();
    this.labels.clear();
    this.page.stage.changed();
  }

  private click(x: number, y: number): void {
    if (this.tool === "look") return;
    const { page } = this;
    const hit = this.hit_near(x, y);
    if (!hit) return page.hint("There is no obstacle to click on here: click on the floor or a wall, or type the place");
    if (this.tool === "measure") return this.measure(hit.place);
    if (hit.is_cut) return page.hint("This is inside an obstacle that is cut: click on the floor, or cut higher");
    const room = this.query.radius + page.info.voxel_size;
    const asked = input("lift").valueAsNumber;
    if (Number.isNaN(asked)) return page.hint("Click height is no number");
    // In the middle of what is lower.
    const ceiling = page.surface.hit(new THREE.Ray(hit.place.clone().addScaledVector(hit.normal, 1e-3), new THREE.Vector3(0, 0, 1)), true);
    const lift = Math.max(Math.min(asked, (ceiling?.distance ?? Infinity) / 2), room);
    const place = hit.place.clone().addScaledVector(hit.normal, hit.normal.z > 0 ? lift : room);
    if (page.info.planar) place.z = hit.place.z;
    const which = this.tool;
    this.query.set_end(which, this.rounded(place));
    this.use(which === "start" && !this.query.goal ? "goal" : "look");
    void this.query.plan();
  }

  /** What is clicked on, past holes that scans leave in floors. */
  private hit_near(x: number, y: number): Hit | undefined {
    for (const off of kAround) {
      const hit = this.hit_at(x + off.x, y + off.y);
      if (hit) return hit;
    }
    return undefined;
  }

  /** What is clicked on: an obstacle, or on a planar map, which has no floor, the layer that robots are in. */
  private hit_at(x: number, y: number): Hit | undefined {
    const { stage, info, base } = this.page;
    const ray = stage.ray_at(x, y);
    const hit = this.page.heights.hit(ray);
    if (!info.planar || !info.bounds) return hit;
    const normal = new THREE.Vector3(0, 0, 1);
    const place = ray.intersectPlane(new THREE.Plane(normal, base.z - info.bounds.min[2] - info.voxel_size / 2), new THREE.Vector3());
    if (!place || !stage.box.clone().expandByScalar(1e-6).containsPoint(place)) return hit;
    const distance = place.distanceTo(ray.origin);
    return hit && hit.distance < distance ? hit : { distance, place, normal };
  }

  /** In the world, to millimetres. */
  private rounded(place: THREE.Vector3): Vector {
    return this.page.routes.world(place).map((v) => Number(v.toFixed(3))) as Vector;
  }

  private measure(place: THREE.Vector3): void {
    if (!this.measure_from) {
      this.clear_measured();
      this.measure_from = place;
      const mark = ball(kMeasure, Math.max(0.05, 5 / this.page.stage.css_pixels_of(1)));
      mark.position.copy(place);
      this.measured.add(mark);
      this.page.hint(kSecond);
      this.page.stage.changed();
      return;
    }
    const from = this.measure_from;
    this.measured.add(new PathDrawing(kMeasure, 3).show([from, place]).group);
    const rise = place.z - from.z;
    const length = from.distanceTo(place);
    this.labels.add(from.clone().lerp(place, 0.5), `${metres(length, 2)} m`);
    this.page.hint(`${metres(length)} m: ${metres(Math.hypot(place.x - from.x, place.y - from.y))} m across, ${metres(rise)} m up`);
    this.measure_from = undefined;
    this.page.stage.changed();
  }

  private begin_drag(which: "start" | "goal", event: PointerEvent): void {
    event.stopImmediatePropagation();
    const { stage, routes } = this.page;
    const marker = routes[which];
    const upright = event.altKey && !stage.is_orthographic;
    const begin = marker.position.clone();
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(new THREE.Vector3(0, 0, 1), begin);
    const on = (ray: THREE.Ray) => (upright ? nearest_upright(ray, begin) : ray.intersectPlane(plane, new THREE.Vector3()));
    const offset = begin.clone().sub(on(stage.ray_at(event.offsetX, event.offsetY)) ?? begin);
    this.dragged = { pointer: event.pointerId, which, from: this.query[which]!, place: (ray) => on(ray)?.add(offset) ?? null };
    this.query.is_dragging = true;
    stage.controls.enabled = false;
    stage.moves_over(true);
    element("canvas").setPointerCapture(event.pointerId);
    element("canvas").style.cursor = "grabbing";
  }

  private drag(event: PointerEvent): void {
    const { which, place } = this.dragged!;
    const { stage } = this.page;
    const at = place(stage.ray_at(event.offsetX, event.offsetY));
    if (!at) return;
    stage.box.clampPoint(at, at);
    this.query.set_end(which, this.rounded(at));
    void this.query.plan();
  }

  /** Puts what is dragged back. */
  take_back(): void {
    if (!this.dragged) return;
    this.query.set_end(this.dragged.which, this.dragged.from);
    this.end_drag();
  }

  private end_drag(): void {
    if (!this.dragged) return;
    this.dragged = undefined;
    this.query.is_dragging = false;
    this.page.stage.controls.enabled = true;
    this.page.stage.moves_over(false);
    element("canvas").style.cursor = "";
    void this.query.plan(); // once more, with what takes longer
  }
}
