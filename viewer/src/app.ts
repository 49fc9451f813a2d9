// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";
import { kDark } from "./colours";
import { element, input } from "./dom";
import { ClearanceScale } from "./drawings";
import { FlightPanel } from "./flight";
import { HeightPanel } from "./heights";
import { connect_keys } from "./keys";
import { LayerPanel } from "./layer_panel";
import type { Info, Vector } from "./layers";
import { Legend } from "./legend";
import { counted, metres, metres_at_least } from "./numbers";
import type { Page } from "./page";
import { Pointing } from "./pointing";
import { QueryPanel } from "./query";
import { RouteDrawing } from "./routes";
import type { MapSource } from "./source";
import type { Stage } from "./stage";
import type { SurfaceMesh } from "./surface";

/** The page: its parts, put together. */
export class App implements Page {
  readonly routes: RouteDrawing;
  readonly scale: ClearanceScale;
  readonly flight: FlightPanel;
  readonly heights: HeightPanel;
  readonly layers: LayerPanel;
  readonly query: QueryPanel;
  /** Of parts that not every page has. */
  readonly explain_more: ((legend: Legend) => void)[] = [];
  private readonly legend = new Legend(element<HTMLDetailsElement>("legend-box"), element("legend"));

  constructor(readonly source: MapSource, readonly stage: Stage, readonly info: Info, readonly base: THREE.Vector3, readonly surface: SurfaceMesh) {
    this.scale = new ClearanceScale(info.min_clearance, Math.max(2 * info.min_clearance, info.min_clearance + 1));
    this.routes = new RouteDrawing(stage, base);
    const fly_to = (place: Vector) => {
      const local = this.routes.local(place);
      const hides = (ray: THREE.Ray, distance: number) => (surface.hit(ray)?.distance ?? Infinity) < distance;
      const above = new THREE.Vector3(0, 0, 1);
      if (hides(new THREE.Ray(local, above), Infinity)) this.heights.cut_at(local.z + 2 * this.query.radius); // a ceiling
      stage.fly_to(local, Math.max(1, 4 * this.query.radius), hides);
      element("canvas").focus();
    };
    this.heights = new HeightPanel(this);
    this.layers = new LayerPanel(this, this.heights.slice, () => this.heights.show_slice(), fly_to);
    this.heights.is_slice_shown = () => this.layers.is_shown("slice");
    this.heights.show_slice_layer = () => void this.layers.show("slice", true);
    this.flight = new FlightPanel(this);
    this.flight.is_shown = () => this.layers.is_shown("flight");
    this.query = new QueryPanel(this, this.flight, fly_to);
    connect_keys(stage, new Pointing(this, this.query));
    input("lift").disabled = this.layer !== undefined;
    this.tell_map();
    this.update_legend();
    matchMedia(kDark).addEventListener("change", () => this.update_legend());
    const box = element<HTMLDetailsElement>("legend-box");
    stage.covered = () => (box.hidden || !box.open ? 0 : box.offsetLeft + box.offsetWidth);
    stage.look_again();
  }

  get layer(): number | undefined {
    const { planar, bounds, voxel_size } = this.info;
    return planar && bounds ? bounds.min[2] + voxel_size / 2 : undefined;
  }

  hint(text: string): void {
    element("hint").textContent = text;
  }

  update_legend(): void {
    if (!this.query) return; // not put together yet
    this.legend.begin();
    this.layers.explain(this.legend);
    this.query.explain(this.legend, this.layers.is_shown("routes"));
    this.flight.explain(this.legend);
    for (const explain of this.explain_more) explain(this.legend);
    this.legend.end();
  }

  tell_map(): void {
    const { info } = this;
    document.title = `${info.name} - Ridgeway`;
    element("name").textContent = info.name;
    const { x, y, z } = this.stage.size;
    element("facts").textContent =
      `${(this.layer === undefined ? [x, y, z] : [x, y]).map((side) => metres(side, side < 1 ? 3 : 1)).join(" x ")} m${this.layer === undefined ? "" : `, a plane at z = ${metres(this.layer)} m`}, voxels of ${metres(info.voxel_size)} m, ` +
      `for robots of ${metres_at_least(info.min_clearance)} m radius and more; ${counted(info.vertices, "vertex", "vertices")}, ${counted(info.edges, "edge", "edges")}`;
  }
}
