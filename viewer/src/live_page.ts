// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";
import { App } from "./app";
import { kAhead, kDrone } from "./colours";
import { element } from "./dom";
import { drone, PathDrawing } from "./drawings";
import type { Info, Vector } from "./layers";
import type { Legend } from "./legend";
import { LiveGraph } from "./live_graph";
import { LiveSurface } from "./live_surface";
import { metres } from "./numbers";
import { ask_json, bytes_of, type MapSource } from "./source";
import { kLeastDrone } from "./routes";
import { Stage } from "./stage";
import { SurfaceMesh } from "./surface";

/** An event of /api/live, as docs/viewer.md describes it. */
interface LiveEvent {
  begins: boolean; // what was there before is to be forgotten
  is_last: boolean;
  scan: number;
  scans: number | null;
  seconds: number;
  position: Vector;
  yaw: number;
  positions: Vector[];
  ahead: Vector[];
  mapped?: number;
  vertices?: number;
  edges?: number;
  bounds?: { min: Vector; max: Vector };
  surface?: string;
  graph?: string;
}

/** Milliseconds after which a server that has not answered, or has no room for this page, is asked again. */
const kAgain = 5000;

/** Milliseconds from a scan until the reason and the trajectory of the route are asked for. */
const kSettle = 1000;

/** A map that grows, and the drone that maps it. */
export class LivePage {
  app?: App;
  readonly graph = new LiveGraph();
  private readonly surface = new LiveSurface();
  private readonly trail: Vector[] = [];
  private readonly drone = drone(kDrone);
  private readonly came = new PathDrawing(kDrone, 2.5);
  private readonly ahead = new PathDrawing(kAhead, 2.5);
  private readonly group = new THREE.Group();
  private events?: EventSource; // while it follows
  private last?: LiveEvent;
  private beginning?: Promise<void>;
  private refresh_asked = false;
  private settling = 0; // until all is planned again
  /** For measurements: bytes of each event, as they came. */
  readonly bytes: number[] = [];

  constructor(private readonly source: MapSource, private readonly stage: Stage, private readonly on_begin: (app: App) => void) {
    this.group.add(this.drone, this.came.group, this.ahead.group);
    stage.overlay.add(this.group);
    this.group.visible = false;
    this.tell("Waiting for the first scan");
    document.addEventListener("visibilitychange", () => this.follow());
    this.follow();
  }

  /**
   * Follows for as long as the page can be seen and the run goes on. A browser has six connections to
   * a server, and each page that follows keeps one: pages that nobody sees must not hold up the others.
   */
  private follow(): void {
    if (document.hidden || this.last?.is_last) {
      this.events?.close();
      this.events = undefined;
    } else if (!this.events) {
      const events = (this.events = new EventSource("/api/live"));
      events.onmessage = (message) => this.take(message.data);
      events.onerror = () => {
        if (events.readyState !== EventSource.CLOSED) {
          const before = this.last ? `${this.event_text(this.last)}. ` : "";
          return this.tell(`${before}The connection is lost; trying again`);
        }
        this.tell("The run cannot be followed: as many pages as can already do; trying again");
        this.ask_server();
        setTimeout(() => this.follow_again(events), kAgain);
      };
    }
  }

  /** After it was refused, which ends the events. */
  private follow_again(refused: EventSource): void {
    if (this.events !== refused) return;
    this.events = undefined;
    this.follow();
  }

  /** Where another map is served now, the answer has the page loaded again. */
  private ask_server(): void {
    this.source.ask("/api/info").catch(() => {});
  }

  private take(text: string): void {
    this.bytes.push(text.length);
    const event: LiveEvent = JSON.parse(text);
    if (event.begins) {
      this.surface.clear();
      this.graph.clear();
      this.trail.length = 0;
      if (this.app) this.ask_server();
    }
    if (event.surface) this.surface.apply(bytes_of(event.surface).buffer);
    if (event.graph) this.graph.apply(bytes_of(event.graph).buffer);
    this.trail.push(...event.positions);
    this.last = event;
    if (event.is_last) this.follow();
    this.ask_refresh();
  }

  /** However many events come, there is one picture of them a frame. */
  private ask_refresh(): void {
    if (this.refresh_asked) return;
    this.refresh_asked = true;
    requestAnimationFrame(() => {
      this.refresh_asked = false;
      void this.refresh();
    });
  }

  private async refresh(): Promise<void> {
    const event = this.last!;
    this.tell(this.event_text(event));
    if (!event.bounds) return;
    this.beginning ??= this.begin(event.bounds);
    await this.beginning;
    if (!this.app) return; // it begins anew in a while
    this.show_map(event);
    this.show_drone(event);
    document.body.dataset.scan = String(event.scan);
    if (event.is_last) document.body.dataset.done = "yes";
  }

  private async begin(bounds: { min: Vector; max: Vector }): Promise<void> {
    let info: Info;
    try {
      info = await ask_json<Info>(this.source, "/api/info");
    } catch (error) {
      this.tell(`The map cannot be shown yet: ${(error as Error).message}`);
      this.beginning = undefined;
      setTimeout(() => this.ask_refresh(), kAgain);
      return;
    }
    const base = new THREE.Vector3(...bounds.min);
    const height = bounds.max[2] - bounds.min[2];
    const surface = new SurfaceMesh(this.surface.whole(), base, height);
    this.stage.scene.add(surface.mesh);
    this.stage.before_frame.push((is_coarse) => surface.draw_coarse(is_coarse));
    this.stage.set_box(new THREE.Vector3(), new THREE.Vector3(...bounds.max).sub(base));
    this.app = new App(this.source, this.stage, info, base, surface);
    this.app.layers.add("live", "Drone and its way", this.group);
    this.app.explain_more.push((legend) => this.explain(legend));
    this.stage.before_frame.push(() => {
      this.drone.scale.setScalar(Math.max(info.min_clearance, kLeastDrone / this.stage.css_pixels_of(1)));
    });
    this.group.visible = true;
    this.stage.look_from_side();
    this.on_begin(this.app);
  }

  private show_map({ bounds, vertices, edges, is_last }: LiveEvent): void {
    const app = this.app!;
    const low = new THREE.Vector3(...bounds!.min).sub(app.base);
    const high = new THREE.Vector3(...bounds!.max).sub(app.base);
    this.stage.set_box(low, high);
    app.surface.replace(this.surface.whole(), low.z, high.z);
    app.heights.follow();
    app.layers.show_graph(this.graph.whole(app.base.toArray() as Vector));
    Object.assign(app.info, { vertices, edges });
    app.tell_map();
    app.update_legend();
    this.stage.look_again();
    this.stage.changed();
    void app.layers.renew();
    this.plan_again(is_last);
  }

  /** At once the route alone; with reason and trajectory once a second at most. */
  private plan_again(is_last: boolean): void {
    const { query } = this.app!;
    if (is_last) window.clearTimeout(this.settling);
    void query.plan(!is_last);
    if (is_last || this.settling) return;
    this.settling = window.setTimeout(() => {
      this.settling = 0;
      if (!query.is_dragging) void query.plan();
    }, kSettle);
  }

  private show_drone({ position, yaw, ahead }: LiveEvent): void {
    const { routes } = this.app!;
    this.came.show(this.trail.map((p) => routes.local(p)));
    this.ahead.show(ahead.map((p) => routes.local(p)));
    this.drone.position.copy(routes.local(position));
    this.drone.rotation.z = yaw;
    this.stage.changed_over();
  }

  private explain(legend: Legend): void {
    if (!this.app?.layers.is_shown("live")) return;
    legend.mark("Drone, and the way that it came", kDrone);
    if (this.last?.ahead.length) legend.mark("Where it flies next", kAhead);
  }

  private event_text({ scan, scans, seconds, mapped, is_last }: LiveEvent): string {
    const parts = [`scan ${scan}${scans ? ` of ${scans}` : ""}`];
    if (mapped !== undefined) parts.push(`${metres(mapped, 1)} m³ mapped`);
    parts.push(`${seconds.toFixed(1)} s`);
    return `${is_last ? "Done" : "Live"}: ${parts.join(", ")}`;
  }

  private tell(text: string): void {
    element("live").hidden = false;
    element("live").textContent = text;
  }
}
