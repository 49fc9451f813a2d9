// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import type * as THREE from "three";
import type { ClearanceScale } from "./drawings";
import type { HeightPanel } from "./heights";
import type { Info } from "./layers";
import type { RouteDrawing } from "./routes";
import type { MapSource } from "./source";
import type { Stage } from "./stage";
import type { SurfaceMesh } from "./surface";

/** What the parts of the page share. */
export interface Page {
  readonly source: MapSource;
  readonly stage: Stage;
  readonly info: Info;
  /** The world's place of (0, 0, 0) of the picture. */
  readonly base: THREE.Vector3;
  readonly surface: SurfaceMesh;
  readonly routes: RouteDrawing;
  readonly scale: ClearanceScale;
  readonly heights: HeightPanel;
  /** The height that robots of a planar map are at, metres, world. */
  readonly layer?: number;
  hint(text: string): void;
  update_legend(): void;
}
