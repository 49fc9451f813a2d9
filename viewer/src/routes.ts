// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";
import { kFlight, kGoal, kNarrow, kRoutes, kStart } from "./colours";
import { ball, drone, PathDrawing } from "./drawings";
import type { Flight, Route, Sample, Vector } from "./layers";
import type { Stage } from "./stage";

/** Pixels: marks are drawn no smaller, however far they are. */
const kLeastRadius = 5;
export const kLeastDrone = 12;

/** Start, goal, the routes between them and the flight along the shortest, as they are drawn. */
export class RouteDrawing {
  readonly start = ball(kStart, 0.3);
  readonly goal = ball(kGoal, 0.3);
  private readonly narrow = ball(kNarrow, 0.3);
  private narrow_radius = 0;
  readonly paths = new THREE.Group();
  readonly flight_group = new THREE.Group();
  private readonly robot = drone(kFlight);
  private readonly line = new PathDrawing(kFlight, 3);
  private readonly drawings: PathDrawing[] = [];
  private samples: Sample[] = [];
  private radius = 0.3;

  constructor(private readonly stage: Stage, private readonly base: THREE.Vector3) {
    this.start.visible = this.goal.visible = this.narrow.visible = this.flight_group.visible = false;
    this.flight_group.add(this.robot, this.line.group);
    stage.overlay.add(this.start, this.goal, this.narrow, this.paths, this.flight_group);
    stage.before_frame.push(() => this.scale_marks());
  }

  get has_flight(): boolean {
    return this.samples.length > 1;
  }

  local(place: Vector): THREE.Vector3 {
    return new THREE.Vector3(place[0] - this.base.x, place[1] - this.base.y, place[2] - this.base.z);
  }
  world(place: THREE.Vector3): Vector {
    return [place.x + this.base.x, place.y + this.base.y, place.z + this.base.z];
  }

  set_radius(radius: number): void {
    this.radius = radius;
    this.scale_marks();
    this.stage.changed_over();
  }

  private scale_marks(): void {
    const least = kLeastRadius / this.stage.css_pixels_of(1);
    for (const part of [this.start, this.goal]) part.scale.setScalar(Math.max(this.radius, least));
    this.robot.scale.setScalar(Math.max(this.radius, kLeastDrone / this.stage.css_pixels_of(1)));
    this.narrow.scale.setScalar(Math.max(this.narrow_radius, least));
  }

  /** `awaits_route`: one from or to there will be shown soon. */
  set_end(which: "start" | "goal", place: Vector | undefined, awaits_route = false): void {
    const marker = this[which];
    marker.visible = !!place;
    if (place) marker.position.copy(this.local(place));
    if (awaits_route) this.stage.changes_with_answer();
    else this.stage.changed_over();
  }

  /** Where the way is too narrow, and the radius that it lets through. */
  set_blocked(place: Vector | undefined, radius: number): void {
    this.narrow.visible = !!place;
    if (!place) return;
    this.narrow.position.copy(this.local(place));
    this.narrow_radius = radius;
    this.scale_marks();
    this.stage.changed_over();
  }

  show_routes(routes: Route[]): void {
    while (this.drawings.length < routes.length) {
      const i = this.drawings.length;
      this.drawings.push(new PathDrawing(kRoutes[i % kRoutes.length]!, i === 0 ? 5 : 3.5));
      this.paths.add(this.drawings[i]!.group);
    }
    this.drawings.forEach((drawing, i) => drawing.show((routes[i]?.waypoints ?? []).map((p) => this.local(p))));
    this.stage.changed_over();
  }

  show_flight(flight: Flight | undefined): void {
    this.samples = flight?.samples ?? [];
    this.flight_group.visible = this.has_flight;
    this.line.show(this.samples.map((s) => this.local(s.position)));
    if (this.has_flight) this.set_time(0);
    this.stage.changed_over();
  }

  /** Puts the drone where it is at a time, and returns that state. */
  set_time(time: number): Sample | undefined {
    const { samples } = this;
    if (samples.length < 2) return undefined;
    let low = 0;
    let high = samples.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (samples[middle]!.t <= time) low = middle;
      else high = middle;
    }
    const [a, b] = [samples[low]!, samples[high]!];
    const share = Math.min(1, Math.max(0, (time - a.t) / Math.max(1e-9, b.t - a.t)));
    const mix = (u: Vector, v: Vector) => u.map((x, k) => x + (v[k]! - x) * share) as Vector;
    const state = { t: time, position: mix(a.position, b.position), velocity: mix(a.velocity, b.velocity), yaw: a.yaw + (b.yaw - a.yaw) * share };
    this.robot.position.copy(this.local(state.position));
    this.robot.rotation.z = state.yaw;
    this.stage.changed_over();
    return state;
  }

  /** The marker at a place of the canvas, with some room for fingers. */
  marker_at(x: number, y: number): "start" | "goal" | undefined {
    const ray = this.stage.ray_at(x, y);
    for (const which of ["goal", "start"] as const) {
      const marker = this[which];
      if (!marker.visible) continue;
      const at = this.stage.on_canvas(marker.position);
      const is_near = at && Math.hypot(at.x - x, at.y - y) < 14;
      if (is_near || ray.distanceToPoint(marker.position) < marker.scale.x) return which;
    }
    return undefined;
  }
}
