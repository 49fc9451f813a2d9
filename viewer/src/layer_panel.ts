// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";
import { join_text, no_joins_text } from "./answer_text";
import { kClearances, kHeights, kNarrow, section_colour } from "./colours";
import { element, input } from "./dom";
import { ball, cloud_drawing, dispose, LabelLayer, NetDrawing, type ColourBy, type SliceDrawing } from "./drawings";
import { read_cloud, read_components, read_net, type Join, type Narrow, type Net, type Vector } from "./layers";
import type { Legend } from "./legend";
import { metres, metres_at_most, volume_text } from "./numbers";
import type { Page } from "./page";
import { ask_json } from "./source";

interface Layer {
  title: string;
  shown: boolean;
  /** Makes what is drawn, when it is first shown. */
  load?: () => Promise<THREE.Object3D>;
  /** When what is being made is there. */
  loading?: Promise<void>;
  object?: THREE.Object3D;
  on_switch?: () => Promise<void>;
}

/** Narrow places that are shown. */
const kMostNarrow = 60;

/** What is drawn of the map, switched on and off. */
export class LayerPanel {
  private readonly labels = new LabelLayer(element("labels"));
  private readonly layers: Record<string, Layer>;
  private readonly diagram: NetDrawing;
  private readonly graph: NetDrawing;
  private renewing = false;
  private is_renewal_wanted = false; // the map has changed since the last was begun
  /** Of the last switch: when what it shows is there. */
  switched: Promise<void> = Promise.resolve();

  constructor(private readonly page: Page, slice: SliceDrawing, show_slice: () => Promise<void>, private readonly fly_to: (place: Vector) => void) {
    const { source, base, scale, stage, surface, routes } = page;
    this.diagram = new NetDrawing(base, scale, 1, 0);
    this.graph = new NetDrawing(base, scale, 2, 5);
    stage.scene.add(slice.mesh);
    stage.before_frame.push(() => this.labels.place((p) => stage.on_canvas(p)));
    this.layers = {
      surface: { title: "Obstacles", shown: true, object: surface.mesh },
      slice: { title: "Distance slice", shown: false, object: slice.mesh, on_switch: show_slice },
      gvd: { title: "Voronoi diagram (GVD)", shown: false, load: async () => cloud_drawing(read_cloud(await source.ask("/api/gvd")), base, scale) },
      diagram: { title: "Skeleton diagram", shown: false, load: async () => this.coloured("diagram", this.diagram.show(read_net(await source.ask("/api/diagram"), false))) },
      graph: { title: "Graph", shown: true, load: async () => this.coloured("graph", this.graph.show(read_net(await source.ask("/api/graph"), true))) },
      narrow: { title: "Narrow places", shown: false, load: () => this.load_narrow() },
      routes: { title: "Routes", shown: true, object: routes.paths },
      flight: { title: "Trajectory and drone", shown: true, object: routes.flight_group },
    };
    for (const name of Object.keys(this.layers)) this.add_switch(name);
    element("colour").addEventListener("change", () => (this.switched = this.colour_nets()));
  }

  is_shown(name: string): boolean {
    return this.layers[name]?.shown ?? false;
  }

  /** Those that are shown at first. */
  async load(): Promise<void> {
    for (const name of Object.keys(this.layers)) if (this.is_shown(name)) await this.show(name, true);
  }

  async show(name: string, shown: boolean): Promise<void> {
    const layer = this.layers[name]!;
    layer.shown = shown;
    input(`layer-${name}`).checked = shown;
    if (shown && !layer.object && layer.load) {
      try {
        await (layer.loading = this.load_layer(name));
      } catch (error) {
        layer.shown = input(`layer-${name}`).checked = false;
        return this.page.hint(`${layer.title}: ${(error as Error).message}`);
      }
    }
    if (layer.object) layer.object.visible = layer.shown && (name !== "flight" || this.page.routes.has_flight);
    await layer.on_switch?.();
    if (name === "narrow") {
      this.labels.visible = layer.shown;
      element("narrow-section").hidden = !layer.shown;
    }
    this.page.update_legend();
    this.page.stage.changed();
  }

  /** A layer that others draw. */
  add(name: string, title: string, object: THREE.Object3D): void {
    this.layers[name] = { title, shown: true, object };
    this.add_switch(name);
  }

  /** The graph as it is now, of a map that grows. */
  show_graph(graph: Net): void {
    this.put("graph", this.graph.show(graph).group);
  }

  /** The map has changed: asks again for what is shown of it, and forgets the rest. */
  async renew(): Promise<void> {
    this.is_renewal_wanted = true;
    if (this.renewing) return;
    this.renewing = true;
    while (this.is_renewal_wanted) {
      this.is_renewal_wanted = false;
      for (const name of ["gvd", "diagram", "narrow"]) await this.renew_layer(name);
      if (this.is_shown("slice")) await this.layers.slice!.on_switch?.();
      this.page.stage.changed();
    }
    this.renewing = false;
  }

  private async renew_layer(name: string): Promise<void> {
    const layer = this.layers[name]!;
    try {
      await layer.loading?.catch(() => {}); // of an older map; who has switched it on tells what is wrong
      if (!layer.object) return;
      if (layer.shown) await this.load_layer(name);
      else this.put(name, undefined);
    } catch (error) {
      this.page.hint(`${layer.title}: ${(error as Error).message}`);
    }
  }

  private async load_layer(name: string): Promise<void> {
    this.put(name, await this.layers[name]!.load!());
  }

  explain(legend: Legend): void {
    const { base, surface, scale } = this.page;
    const z = (height: number) => `${metres(base.z + height, 2)} m`;
    if (this.is_shown("surface")) legend.ramp("Obstacles: height", kHeights, z(surface.low), z(surface.high));
    if (this.is_shown("surface")) legend.mark("Obstacles where they are cut", section_colour());
    const has_net = this.is_shown("diagram") || this.is_shown("graph");
    const by_component = this.colour_by === "component";
    if (has_net && by_component) legend.mark("Graph, diagram: a colour for each connected component", [0.5, 0.5, 0.5]);
    if ((has_net && !by_component) || this.is_shown("gvd") || this.is_shown("slice"))
      legend.ramp("Clearance to obstacles", kClearances, `${metres(scale.least, 2)} m`, `${metres(scale.most, 2)} m and more`);
    if (this.is_shown("slice")) legend.mark(`Slice: nearer than ${metres(scale.least, 2)} m, no room`, [0.35, 0.05, 0.08]);
    if (this.is_shown("narrow") && this.layers.narrow!.object?.children.length) legend.mark("Narrow place, with the radius that it lets through", kNarrow);
  }

  private async colour_nets(): Promise<void> {
    try {
      if (this.layers.diagram!.object) await this.coloured("diagram", this.diagram);
      if (this.layers.graph!.object) await this.coloured("graph", this.graph);
    } catch (error) {
      element<HTMLSelectElement>("colour").value = "clearance";
      this.page.hint(`Components: ${(error as Error).message}`);
    }
    this.page.update_legend();
    this.page.stage.changed();
  }

  /** Components are asked for where colours show them: they take longer than all that is drawn. */
  private async coloured(of: "diagram" | "graph", net: NetDrawing): Promise<THREE.Object3D> {
    if (this.colour_by === "component" && !net.knows_components)
      net.components = read_components(await this.page.source.ask("/api/components", { of }));
    net.colour_by(this.colour_by);
    return net.group;
  }

  private get colour_by(): ColourBy {
    return element<HTMLSelectElement>("colour").value as ColourBy;
  }

  private add_switch(name: string): void {
    const layer = this.layers[name]!;
    const label = document.createElement("label");
    const box = document.createElement("input");
    box.type = "checkbox";
    box.id = `layer-${name}`;
    box.checked = layer.shown;
    box.addEventListener("change", () => (this.switched = this.show(name, box.checked)));
    label.append(box, layer.title);
    element("layers").append(label);
  }

  private put(name: string, object: THREE.Object3D | undefined): void {
    const layer = this.layers[name]!;
    if (layer.object && layer.object !== object) dispose(layer.object.removeFromParent());
    layer.object = object;
    if (!object) return;
    object.visible = layer.shown;
    this.page.stage.scene.add(object);
  }

  private async load_narrow(): Promise<THREE.Object3D> {
    const { joins, components } = await ask_json<Narrow>(this.page.source, "/api/narrow");
    const wide_enough = joins.filter((join) => join.radius > 0.5 * this.page.info.voxel_size);
    // Those that join most space first: of a ragged map most parts are tiny.
    const joined = (join: Join) => Math.min(components[join.a]!.volume, components[join.b]!.volume);
    const shown = [...wide_enough].sort((a, b) => joined(b) - joined(a) || b.radius - a.radius).slice(0, kMostNarrow);
    const marks = new THREE.Group();
    const list = element("narrow-list");
    this.labels.clear();
    list.replaceChildren();
    for (const join of shown) {
      const place = this.page.routes.local(join.place);
      const mark = ball(kNarrow, Math.max(join.radius, 0.04));
      mark.position.copy(place);
      marks.add(mark);
      this.labels.add(place, `${metres_at_most(join.radius)} m`);
      const item = document.createElement("li");
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = join_text(join, (i) => volume_text(components[i]!.volume));
      button.addEventListener("click", () => this.fly_to(join.place));
      item.append(button);
      list.append(item);
    }
    if (shown.length === 0) {
      const none = document.createElement("li");
      none.textContent = no_joins_text(components.length);
      list.append(none);
    }
    if (wide_enough.length > shown.length) this.page.hint(`${shown.length} of ${wide_enough.length} narrow places are shown: those that join the largest parts`);
    return marks;
  }
}
