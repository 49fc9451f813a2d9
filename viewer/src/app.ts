// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";
import { kClearances, kFlight, kGoal, kHeights, kMeasure, kNarrow, kRoutes, kStart } from "./colours";
import { ball, ClearanceScale, cloud_drawing, LabelLayer, NetDrawing, PathDrawing, SliceDrawing, type ColourBy } from "./drawings";
import { read_cloud, read_net, read_slice, type Flight, type Info, type Join, type Narrow, type PlanAnswer, type Route, type Vector } from "./layers";
import { Legend } from "./legend";
import { metres, place_of, place_text, seconds } from "./numbers";
import { RouteDrawing } from "./routes";
import { ask_json, type MapSource } from "./source";
import type { Stage } from "./stage";
import type { SurfaceMesh } from "./surface";

type Tool = "look" | "start" | "goal" | "measure";

interface Layer {
  title: string;
  shown: boolean;
  load?: () => Promise<THREE.Object3D>;
  object?: THREE.Object3D;
  on_switch?: () => void;
}

function element<T extends HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}

/** The controls beside the picture, and what they do. */
export class App {
  private readonly routes: RouteDrawing;
  private readonly scale: ClearanceScale;
  private readonly labels = new LabelLayer(element("labels"));
  private readonly measure_labels = new LabelLayer(element("labels"));
  private readonly legend = new Legend(element("legend"));
  private readonly slice = new SliceDrawing();
  private readonly narrow = new THREE.Group();
  private readonly measured = new THREE.Group();
  private readonly nets: NetDrawing[] = [];
  private readonly layers: Record<string, Layer>;
  private tool: Tool = "look";
  private start?: Vector;
  private goal?: Vector;
  private measure_from?: THREE.Vector3;
  private asking = false; // a plan is under way
  private asked_again = false; // and another one is wanted
  private dragging?: { which: "start" | "goal"; plane: THREE.Plane; offset: THREE.Vector3 };
  private blocked_place?: Vector;
  private shown_routes: Route[] = [];
  private flight?: Flight;
  private playing = 0;
  private slice_asked = false;
  /** For tests and measurements: of the last plan, from the question to its picture. */
  last_round_trip = 0;

  constructor(private readonly source: MapSource, private readonly stage: Stage, private readonly info: Info, private readonly base: THREE.Vector3, private readonly surface: SurfaceMesh) {
    this.scale = new ClearanceScale(info.min_clearance, Math.max(2 * info.min_clearance, info.min_clearance + 1));
    this.routes = new RouteDrawing(stage, base);
    stage.scene.add(this.slice.mesh, this.narrow, this.measured);
    stage.before_frame.push(() => {
      this.labels.place((p) => stage.on_canvas(p));
      this.measure_labels.place((p) => stage.on_canvas(p));
    });
    this.layers = {
      surface: { title: "Obstacles", shown: true, object: surface.mesh },
      slice: { title: "Distance slice", shown: false, object: this.slice.mesh, on_switch: () => this.show_slice() },
      gvd: { title: "Voronoi diagram (GVD)", shown: false, load: async () => cloud_drawing(read_cloud(await source.ask("/api/gvd")), base, this.scale) },
      diagram: { title: "Skeleton diagram", shown: false, load: async () => this.add_net(new NetDrawing(read_net(await source.ask("/api/diagram"), false), base, this.scale, 1.5, 0)) },
      graph: { title: "Graph", shown: true, load: async () => this.add_net(new NetDrawing(read_net(await source.ask("/api/graph"), true), base, this.scale, 2, 5)) },
      narrow: { title: "Narrow places", shown: false, load: () => this.load_narrow() },
      routes: { title: "Routes", shown: true, object: this.routes.paths },
      flight: { title: "Trajectory and drone", shown: true, object: this.routes.flight_group },
    };
    this.tell_map();
    this.add_layer_switches();
    this.connect_heights();
    this.connect_query();
    this.connect_view();
    this.connect_flight();
    this.update_legend();
  }

  /** Those that are shown at first. */
  async load_layers(): Promise<void> {
    for (const name of Object.keys(this.layers)) if (this.layers[name]!.shown) await this.show_layer(name, true);
  }

  private add_net(net: NetDrawing): THREE.Object3D {
    net.colour_by(element<HTMLSelectElement>("colour").value as ColourBy);
    this.nets.push(net);
    return net.group;
  }

  private tell_map(): void {
    const { info } = this;
    document.title = `${info.name} - Ridgeway`;
    element("name").textContent = info.name;
    const size = this.stage.size;
    element("facts").textContent =
      `${metres(size.x, 1)} x ${metres(size.y, 1)} x ${metres(size.z, 1)} m, voxels of ${metres(info.voxel_size)} m, ` +
      `for robots of ${metres(info.min_clearance)} m radius and more; ${info.vertices.toLocaleString("en")} vertices, ${info.edges.toLocaleString("en")} edges`;
  }

  // --- layers ---------------------------------------------------------------------------------

  private add_layer_switches(): void {
    for (const [name, layer] of Object.entries(this.layers)) {
      const label = document.createElement("label");
      const box = document.createElement("input");
      box.type = "checkbox";
      box.id = `layer-${name}`;
      box.checked = layer.shown;
      box.addEventListener("change", () => void this.show_layer(name, box.checked));
      label.append(box, layer.title);
      element("layers").append(label);
    }
    element("colour").addEventListener("change", () => {
      for (const net of this.nets) net.colour_by(element<HTMLSelectElement>("colour").value as ColourBy);
      this.update_legend();
      this.stage.changed();
    });
  }

  private async show_layer(name: string, shown: boolean): Promise<void> {
    const layer = this.layers[name]!;
    layer.shown = shown;
    element<HTMLInputElement>(`layer-${name}`).checked = shown;
    if (shown && !layer.object && layer.load) {
      try {
        const object = await layer.load();
        layer.object = object;
        this.stage.scene.add(object);
      } catch (error) {
        layer.shown = element<HTMLInputElement>(`layer-${name}`).checked = false;
        return this.hint(`${layer.title}: ${(error as Error).message}`);
      }
    }
    if (layer.object) layer.object.visible = layer.shown && (name !== "flight" || !!this.flight);
    layer.on_switch?.();
    if (name === "narrow") {
      this.labels.visible = layer.shown;
      element("narrow-section").hidden = !layer.shown;
    }
    this.update_legend();
    this.stage.changed();
  }

  private async load_narrow(): Promise<THREE.Object3D> {
    const { joins, components } = await ask_json<Narrow>(this.source, "/api/narrow");
    const wide_enough = joins.filter((join) => join.radius > 0.5 * this.info.voxel_size);
    const shown = wide_enough.slice(0, 60);
    for (const join of shown) {
      const place = this.routes.local(join.place);
      const mark = ball(kNarrow, Math.max(join.radius, 0.04));
      mark.position.copy(place);
      this.narrow.add(mark);
      this.labels.add(place, `${metres(join.radius, 2)} m`);
    }
    const list = element("narrow-list");
    const volume = (i: number) => `${metres(components[i]!.volume, 1)} m³`;
    for (const join of shown) {
      const item = document.createElement("li");
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = `radius ${metres(join.radius)} m joins ${volume(join.a)} and ${volume(join.b)}, ${describe(join)}`;
      button.addEventListener("click", () => this.fly_to(join.place));
      item.append(button);
      list.append(item);
    }
    if (shown.length === 0) {
      const none = document.createElement("li");
      none.textContent = "None: all places that a robot fits are connected.";
      list.append(none);
    }
    if (wide_enough.length > shown.length) this.hint(`${shown.length} of ${wide_enough.length} narrow places are shown, the widest`);
    return this.narrow;
  }

  private update_legend(): void {
    const { legend, layers, scale } = this;
    legend.begin();
    const z = (height: number) => `${metres(this.base.z + height, 2)} m`;
    if (layers.surface!.shown) legend.ramp("Obstacles: height", kHeights, z(0), z(this.surface.high));
    const by_component = element<HTMLSelectElement>("colour").value === "component";
    const has_net = layers.diagram!.shown || layers.graph!.shown;
    if (has_net && by_component) legend.mark("Graph, diagram: a colour for each connected component", [0.5, 0.5, 0.5]);
    if ((has_net && !by_component) || layers.gvd!.shown || layers.slice!.shown)
      legend.ramp("Clearance to obstacles", kClearances, `${metres(scale.least, 2)} m`, `${metres(scale.most, 2)} m and more`);
    if (layers.slice!.shown) legend.mark(`Slice: nearer than ${metres(scale.least, 2)} m, no room`, [0.35, 0.05, 0.08]);
    if (layers.narrow!.shown) legend.mark("Narrow place, with the radius that it lets through", kNarrow);
    if (this.start) legend.mark("Start", kStart);
    if (this.goal) legend.mark("Goal", kGoal);
    if (layers.routes!.shown)
      this.shown_routes.forEach((route, i) => legend.mark(`Route ${this.shown_routes.length > 1 ? `${i + 1}, ` : ""}${metres(route.length, 2)} m`, kRoutes[i % kRoutes.length]!));
    if (this.flight && layers.flight!.shown) legend.mark(`Trajectory, ${metres(this.flight.duration, 2)} s`, kFlight);
    legend.end();
  }

  // --- heights --------------------------------------------------------------------------------

  private connect_heights(): void {
    const step = this.info.voxel_size;
    const size = this.stage.size.z;
    for (const id of ["cut", "slice"]) Object.assign(element<HTMLInputElement>(id), { min: "0", max: String(size + step), step: String(step) });
    element<HTMLInputElement>("cut").value = String(this.surface.cut);
    element<HTMLInputElement>("slice").value = String(Math.min(size / 2, 1));
    const tell = () => {
      for (const id of ["cut", "slice"]) element(`${id}-text`).textContent = `${metres(this.base.z + element<HTMLInputElement>(id).valueAsNumber, 2)} m`;
    };
    element("cut").addEventListener("input", () => {
      this.surface.cut = element<HTMLInputElement>("cut").valueAsNumber;
      tell();
      this.stage.changed();
    });
    element("slice").addEventListener("input", () => {
      tell();
      if (this.layers.slice!.shown) void this.show_slice();
      else void this.show_layer("slice", true);
    });
    tell();
  }

  private async show_slice(): Promise<void> {
    if (!this.layers.slice!.shown || this.slice_asked) return;
    this.slice_asked = true;
    const input = element<HTMLInputElement>("slice");
    try {
      for (let height = NaN; height !== input.valueAsNumber; ) {
        height = input.valueAsNumber;
        const bytes = await this.source.ask("/api/slice", { z: String(this.base.z + height) });
        this.slice.show(read_slice(bytes), this.base, this.scale);
        this.stage.changed();
      }
    } catch (error) {
      this.hint((error as Error).message);
    }
    this.slice_asked = false;
  }

  // --- query ----------------------------------------------------------------------------------

  private get radius(): number {
    return element<HTMLInputElement>("radius").valueAsNumber || this.info.min_clearance;
  }

  private connect_query(): void {
    const radius = element<HTMLInputElement>("radius");
    radius.value = metres(this.info.min_clearance);
    this.routes.set_radius(this.radius);
    for (const id of ["from", "to"] as const) {
      element<HTMLInputElement>(id).addEventListener("change", () => {
        const place = place_of(element<HTMLInputElement>(id).value);
        this.set_end(id === "from" ? "start" : "goal", place);
        void this.plan();
      });
    }
    for (const id of ["radius", "planner", "alternatives", "prefer", "snap"])
      element(id).addEventListener("change", () => {
        this.routes.set_radius(this.radius);
        void this.plan();
      });
    element("query").addEventListener("submit", (event) => {
      event.preventDefault();
      void this.plan();
    });
    element("show-place").addEventListener("click", () => this.blocked_place && this.fly_to(this.blocked_place));
  }

  /** Sets an end, for the form and the picture. */
  set_end(which: "start" | "goal", place: Vector | undefined): void {
    this[which] = place;
    this.routes.set_end(which, place);
    if (place) element<HTMLInputElement>(which === "start" ? "from" : "to").value = place_text(place).replaceAll(",", ", ");
    this.update_legend();
  }

  private parameters(dragging: boolean): Record<string, string> {
    const value = (id: string) => element<HTMLInputElement>(id).value;
    const parameters: Record<string, string> = { from: place_text(this.start!), to: place_text(this.goal!), radius: value("radius"), planner: value("planner"), prefer_clearance: value("prefer"), snap: value("snap") };
    if (Number(value("alternatives")) > 1 && value("planner") === "graph") parameters.alternatives = value("alternatives");
    if (dragging) parameters.explain = "0";
    return parameters;
  }

  /** Plans; while one is under way the next waits, and of those that wait only the last is asked. */
  async plan(): Promise<void> {
    if (!this.start || !this.goal) return;
    this.asked_again = true;
    if (this.asking) return;
    this.asking = true;
    while (this.asked_again) {
      this.asked_again = false;
      const started = performance.now();
      const dragging = !!this.dragging;
      try {
        const answer = await ask_json<PlanAnswer>(this.source, "/api/plan", this.parameters(dragging));
        this.show_answer(answer);
        this.stage.draw();
        this.last_round_trip = performance.now() - started;
        if (answer.status === "ok" && !dragging && !this.asked_again) await this.fly();
      } catch (error) {
        this.show_failure((error as Error).message);
      }
    }
    this.asking = false;
    document.body.dataset.planned = String(Number(document.body.dataset.planned ?? 0) + 1);
  }

  private show_answer(answer: PlanAnswer): void {
    const routes = answer.routes ?? (answer.status === "ok" ? [answer as Route] : []);
    this.shown_routes = routes;
    this.routes.show_routes(routes);
    this.set_flight(undefined);
    this.blocked_place = answer.blocked?.place ?? undefined;
    element("show-place").hidden = !this.blocked_place;
    element("command").textContent = this.command();
    if (routes.length === 0) this.show_failure(reason_text(answer));
    else element("result").replaceChildren(...route_rows(routes, answer));
    this.update_legend();
  }

  private show_failure(text: string): void {
    const line = document.createElement("p");
    line.className = "bad";
    line.textContent = text;
    element("result").replaceChildren(line);
  }

  /** The same question on the command line. */
  private command(): string {
    const parameters = this.parameters(false);
    const words = ["ridgeway plan", this.info.name, `--from=${parameters.from}`, `--to=${parameters.to}`, `--radius ${parameters.radius}`];
    if (parameters.planner !== "graph") words.push(`--planner ${parameters.planner}`);
    if (Number(parameters.prefer_clearance) > 0) words.push(`--prefer-clearance ${parameters.prefer_clearance}`);
    if (Number(parameters.snap) > 0) words.push(`--snap ${parameters.snap}`);
    if (parameters.alternatives) words.push(`--alternatives ${parameters.alternatives}`);
    return words.join(" ");
  }

  // --- flight ---------------------------------------------------------------------------------

  private connect_flight(): void {
    const time = element<HTMLInputElement>("time");
    time.addEventListener("input", () => this.set_time(time.valueAsNumber));
    element("play").addEventListener("click", () => (this.playing ? this.stop() : this.play()));
    element("speed").addEventListener("change", () => void this.fly());
  }

  private async fly(): Promise<void> {
    if (!this.start || !this.goal || this.shown_routes.length === 0) return;
    const { alternatives: _, ...parameters } = this.parameters(false);
    try {
      const flight = await ask_json<Flight>(this.source, "/api/trajectory", { ...parameters, max_speed: element<HTMLInputElement>("speed").value });
      this.set_flight(flight.status === "ok" ? flight : undefined);
    } catch (error) {
      this.hint((error as Error).message);
    }
  }

  private set_flight(flight: Flight | undefined): void {
    this.stop();
    this.flight = flight;
    this.routes.show_flight(flight);
    if (!this.layers.flight!.shown) this.routes.flight_group.visible = false;
    element("flight").hidden = !flight;
    if (flight) {
      const time = element<HTMLInputElement>("time");
      time.max = String(flight.duration);
      time.value = "0";
      this.set_time(0);
    }
    this.update_legend();
  }

  private set_time(time: number): void {
    const state = this.routes.set_time(time);
    if (!state || !this.flight) return;
    element<HTMLInputElement>("time").value = String(time);
    element("clock").textContent = `${time.toFixed(1)} of ${this.flight.duration.toFixed(1)} s`;
    element("state").textContent = `${Math.hypot(...state.velocity).toFixed(2)} m/s at ${place_text(state.position)}; clearance ${metres(this.flight.clearance ?? Infinity)} m at least`;
  }

  private play(): void {
    if (!this.flight) return;
    const time = element<HTMLInputElement>("time");
    const from = time.valueAsNumber >= this.flight.duration - 0.05 ? 0 : time.valueAsNumber;
    const started = performance.now();
    element("play").setAttribute("aria-pressed", "true");
    element("play").textContent = "Stop";
    const step = () => {
      this.stage.moves();
      const now = Math.min(this.flight!.duration, from + (performance.now() - started) / 1000);
      this.set_time(now);
      if (now < this.flight!.duration) this.playing = requestAnimationFrame(step);
      else this.stop();
    };
    this.playing = requestAnimationFrame(step);
  }

  private stop(): void {
    cancelAnimationFrame(this.playing);
    this.playing = 0;
    element("play").setAttribute("aria-pressed", "false");
    element("play").textContent = "Fly";
  }

  // --- view -----------------------------------------------------------------------------------

  private connect_view(): void {
    for (const button of document.querySelectorAll<HTMLButtonElement>("[data-tool]"))
      button.addEventListener("click", () => this.use(button.dataset.tool as Tool));
    element("orbit").addEventListener("click", () => this.stage.look_from_side());
    element("top").addEventListener("click", () => this.stage.look_from_above());
    const canvas = element<HTMLCanvasElement>("canvas");
    let down: { x: number; y: number } | undefined;
    canvas.addEventListener("pointerdown", (event) => {
      down = { x: event.offsetX, y: event.offsetY };
      const which = event.button === 0 ? this.routes.marker_at(event.offsetX, event.offsetY) : undefined;
      if (which) this.begin_drag(which, event);
    }, { capture: true });
    canvas.addEventListener("pointermove", (event) => {
      if (this.dragging) this.drag(event);
      else if (event.buttons === 0) canvas.style.cursor = this.routes.marker_at(event.offsetX, event.offsetY) ? "grab" : this.tool === "look" ? "" : "crosshair";
    });
    canvas.addEventListener("pointerup", (event) => {
      if (this.dragging) return this.end_drag();
      if (down && event.button === 0 && Math.hypot(event.offsetX - down.x, event.offsetY - down.y) < 5) this.click(event.offsetX, event.offsetY);
    });
    canvas.addEventListener("pointercancel", () => this.end_drag());
    document.addEventListener("keydown", (event) => this.key(event));
  }

  private use(tool: Tool): void {
    this.tool = tool;
    this.measure_from = undefined;
    for (const button of document.querySelectorAll<HTMLButtonElement>("[data-tool]")) button.setAttribute("aria-pressed", String(button.dataset.tool === tool));
    this.hint({ look: "", start: "Click where the route starts", goal: "Click where the route ends", measure: "Click two places" }[tool]);
  }

  hint(text: string): void {
    element("hint").textContent = text;
  }

  private click(x: number, y: number): void {
    if (this.tool === "look") return;
    const hit = this.surface.hit(this.stage.ray_at(x, y));
    if (!hit) return this.hint("There is no obstacle to click on here: click on the floor or a wall");
    if (this.tool === "measure") return this.measure(hit.place);
    const room = this.radius + this.info.voxel_size;
    const lift = Math.max(element<HTMLInputElement>("lift").valueAsNumber || 0, room);
    const place = hit.place.clone().addScaledVector(hit.normal, hit.normal.z > 0 ? lift : room);
    if (this.info.planar) place.z = hit.place.z;
    const which = this.tool;
    this.set_end(which, this.routes.world(place).map((v) => Number(v.toFixed(3))) as Vector);
    this.use(which === "start" && !this.goal ? "goal" : "look");
    void this.plan();
  }

  private measure(place: THREE.Vector3): void {
    if (!this.measure_from) {
      this.clear_measured();
      this.measure_from = place;
      const mark = ball(kMeasure, 0.05);
      mark.position.copy(place);
      this.measured.add(mark);
      return this.stage.changed();
    }
    const from = this.measure_from;
    const line = new PathDrawing([from, place], kMeasure, 3);
    this.measured.add(line.group);
    const rise = place.z - from.z;
    const length = from.distanceTo(place);
    this.measure_labels.add(from.clone().lerp(place, 0.5), `${metres(length, 2)} m`);
    this.hint(`${metres(length)} m: ${metres(Math.hypot(place.x - from.x, place.y - from.y))} m across, ${metres(rise)} m up`);
    this.measure_from = undefined;
    this.stage.changed();
  }

  private clear_measured(): void {
    this.measured.clear();
    this.measure_labels.clear();
  }

  private begin_drag(which: "start" | "goal", event: PointerEvent): void {
    event.stopImmediatePropagation();
    const marker = this.routes[which];
    const upright = event.altKey && !this.stage.is_orthographic;
    const ray = this.stage.ray_at(event.offsetX, event.offsetY);
    const normal = upright ? ray.direction.clone().setZ(0).normalize().negate() : new THREE.Vector3(0, 0, 1);
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(normal, marker.position);
    const at = ray.intersectPlane(plane, new THREE.Vector3()) ?? marker.position;
    this.dragging = { which, plane, offset: marker.position.clone().sub(at) };
    this.stage.controls.enabled = false;
    element("canvas").setPointerCapture(event.pointerId);
    element("canvas").style.cursor = "grabbing";
  }

  private drag(event: PointerEvent): void {
    const { which, plane, offset } = this.dragging!;
    const at = this.stage.ray_at(event.offsetX, event.offsetY).intersectPlane(plane, new THREE.Vector3());
    if (!at) return;
    at.add(offset);
    this.stage.moves();
    const most = this.stage.size;
    at.clamp(new THREE.Vector3(), most);
    this.set_end(which, this.routes.world(at).map((v) => Number(v.toFixed(3))) as Vector);
    void this.plan();
  }

  private end_drag(): void {
    if (!this.dragging) return;
    this.dragging = undefined;
    this.stage.controls.enabled = true;
    element("canvas").style.cursor = "";
    void this.plan(); // once more, with what takes longer
  }

  private fly_to(place: Vector): void {
    this.stage.fly_to(this.routes.local(place), Math.max(1, 4 * this.radius));
    element("canvas").focus();
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey) return;
    const target = event.target as HTMLElement;
    if (target instanceof HTMLInputElement || target instanceof HTMLSelectElement) {
      if (event.key === "Escape") element("canvas").focus();
      return;
    }
    const tools: Record<string, Tool> = { s: "start", g: "goal", m: "measure", Escape: "look" };
    const tool = tools[event.key];
    if (tool) {
      if (event.key === "Escape") {
        this.clear_measured();
        this.stage.changed();
      }
      return this.use(tool);
    }
    if (event.key === "t") return this.stage.look_from_above();
    if (event.key === "o") return this.stage.look_from_side();
    if (target.id !== "canvas" && target !== document.body) return;
    const turn = 0.12;
    const turns: Record<string, [number, number, number]> = {
      ArrowLeft: [-turn, 0, 1], ArrowRight: [turn, 0, 1], ArrowUp: [0, turn, 1], ArrowDown: [0, -turn, 1],
      "+": [0, 0, 0.85], "=": [0, 0, 0.85], "-": [0, 0, 1 / 0.85],
    };
    const change = turns[event.key];
    if (!change) return;
    event.preventDefault();
    this.stage.turn(...change);
  }
}

function describe(join: Join): string {
  return join.by === "unknown" ? "between unknown space" : "between obstacles";
}

/** Why there is no route, beginning with what to change. */
function reason_text(answer: PlanAnswer): string {
  const { blocked, radius, reason } = answer;
  const full = reason ?? `No route: ${answer.status.replaceAll("_", " ")}`;
  if (!blocked || blocked.radius <= 0 || !blocked.place) return full;
  const narrow = blocked.by === "unknown" ? "Unknown space leaves" : "The way is";
  return `${narrow} too narrow by ${metres(Math.max(0.001, radius - blocked.radius))} m at ${place_text(blocked.place)}. ${full}`;
}

function route_rows(routes: Route[], answer: PlanAnswer): HTMLElement[] {
  const first = routes[0]!;
  const head = document.createElement("p");
  const length = document.createElement("strong");
  length.id = "length";
  length.textContent = `${metres(first.length)} m`;
  head.append(length);
  const table = document.createElement("table");
  const row = (name: string, value: string) => {
    const line = table.insertRow();
    const th = document.createElement("th");
    th.scope = "row";
    th.textContent = name;
    line.append(th);
    line.insertCell().textContent = value;
  };
  row("clearance", first.clearance === null ? "no obstacle near" : `${metres(first.clearance)} m`);
  row("planned in", seconds(answer.seconds.total));
  row("answered by", `the ${first.answered_by}, ${first.waypoints.length} waypoints`);
  if (first.within !== undefined) row("shortest", first.within <= 1.0005 ? "there is no shorter one" : `within ${(100 * (first.within - 1)).toFixed(1)} % of it`);
  if (first.moved_start) row("start", `moved by ${metres(first.moved_start.distance)} m`);
  if (first.moved_goal) row("goal", `moved by ${metres(first.moved_goal.distance)} m`);
  routes.slice(1).forEach((route, i) => row(`route ${i + 2}`, `${metres(route.length)} m, clearance ${metres(route.clearance ?? Infinity)} m`));
  if (answer.routes && answer.complete) row("", "the graph has no others");
  return [head, table];
}
