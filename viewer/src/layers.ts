// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

// The binary layers of docs/viewer.md, decoded.

export type Vector = [number, number, number];

/** Reads one array after another. */
export class Reader {
  private at = 0;
  constructor(private readonly bytes: ArrayBuffer) {}

  origin(): Vector {
    return [...this.take(Float64Array, 3)] as Vector;
  }
  f64(): number {
    return this.take(Float64Array, 1)[0]!;
  }
  u32(): number {
    return this.take(Uint32Array, 1)[0]!;
  }
  take<T extends Float64Array | Float32Array | Int32Array | Uint32Array | Uint16Array | Uint8Array>(
    type: { new (bytes: ArrayBuffer, offset: number, length: number): T; BYTES_PER_ELEMENT: number }, length: number): T {
    const at = this.at;
    this.at += length * type.BYTES_PER_ELEMENT;
    if (at % type.BYTES_PER_ELEMENT === 0) return new type(this.bytes, at, length);
    return new type(this.bytes.slice(at, this.at), 0, length);
  }
}

export interface Surface {
  origin: Vector;
  cell: number; // side, metres
  cell_voxels: number;
  count: number;
  cells: Uint16Array | Uint32Array; // x, y, z, side of each quad
  sizes: Uint8Array; // width, height, 0, 0
}

export function read_surface(bytes: ArrayBuffer): Surface {
  const reader = new Reader(bytes);
  const origin = reader.origin();
  const cell = reader.f64();
  const count = reader.u32();
  const cell_voxels = reader.u32();
  return { origin, cell, cell_voxels, count, cells: reader.take(Uint16Array, 4 * count), sizes: reader.take(Uint8Array, 4 * count) };
}

/** Places, what joins them by pairs, and what is known of both. */
export interface Net {
  origin: Vector;
  positions: Float32Array;
  clearance: Float32Array;
  pairs: Uint32Array;
  pair_clearance?: Float32Array;
  /** Numbers of the connected components that places lie in, where they are known. */
  component?: Uint32Array;
}

export function read_net(bytes: ArrayBuffer, has_pair_clearance: boolean): Net {
  const reader = new Reader(bytes);
  const origin = reader.origin();
  const count = reader.u32();
  const pair_count = reader.u32();
  const net: Net = {
    origin,
    positions: reader.take(Float32Array, 3 * count),
    clearance: reader.take(Float32Array, count),
    pairs: reader.take(Uint32Array, 2 * pair_count),
  };
  if (has_pair_clearance) net.pair_clearance = reader.take(Float32Array, pair_count);
  return net;
}

export function read_components(bytes: ArrayBuffer): Uint32Array {
  const reader = new Reader(bytes);
  return reader.take(Uint32Array, reader.u32());
}

export interface Cloud {
  origin: Vector;
  positions: Float32Array;
  clearance: Float32Array;
  total: number; // of which these are some
}

export function read_cloud(bytes: ArrayBuffer): Cloud {
  const reader = new Reader(bytes);
  const origin = reader.origin();
  const count = reader.u32();
  const total = reader.u32();
  return { origin, total, positions: reader.take(Float32Array, 3 * count), clearance: reader.take(Float32Array, count) };
}

export interface Slice {
  origin: Vector; // of the corner of the first sample, at the height of voxel centres
  step: number; // metres
  columns: number;
  rows: number;
  millimetres: Uint16Array;
}
export const kNotKnown = 65535;

export function read_slice(bytes: ArrayBuffer): Slice {
  const reader = new Reader(bytes);
  const origin = reader.origin();
  const step = reader.f64();
  const columns = reader.u32();
  const rows = reader.u32();
  return { origin, step, columns, rows, millimetres: reader.take(Uint16Array, columns * rows) };
}

/** Cells at a height: those that a cut there goes through. */
export interface Section {
  origin: Vector; // of the corner of the first cell
  step: number; // metres
  columns: number;
  rows: number;
  bits: Uint8Array; // a cell each, the lowest first
}

export function read_section(bytes: ArrayBuffer): Section {
  const reader = new Reader(bytes);
  const origin = reader.origin();
  const step = reader.f64();
  const columns = reader.u32();
  const rows = reader.u32();
  return { origin, step, columns, rows, bits: reader.take(Uint8Array, Math.ceil((columns * rows) / 8)) };
}

// JSON answers.

export interface Info {
  name: string;
  live?: boolean; // it grows: /api/live tells how
  source: string;
  voxel_size: number;
  min_clearance: number;
  largest_radius: number | null;
  unknown: string;
  planar: boolean;
  bounds: { min: Vector; max: Vector } | null;
  limits: { keep_in: (number | null)[]; keep_out: (number | null)[][] };
  vertices: number;
  edges: number;
  voxels: { free: number; occupied: number };
}

export interface Route {
  status: string;
  answered_by: string;
  length: number;
  within?: number;
  clearance: number | null;
  waypoints: Vector[];
  seconds: { total: number };
  moved_start?: { distance: number; place: Vector };
  moved_goal?: { distance: number; place: Vector };
}

export interface Blocked {
  radius: number;
  place: Vector | null;
  by: string;
}

export interface PlanAnswer extends Partial<Route> {
  status: string;
  radius: number;
  seconds: { total: number };
  routes?: Route[];
  complete?: boolean;
  reason?: string;
  blocked?: Blocked;
}

export interface Sample {
  t: number;
  position: Vector;
  velocity: Vector;
  yaw: number;
}

export interface Flight {
  status: string;
  reason?: string;
  duration: number;
  clearance: number | null;
  step: string;
  samples: Sample[];
  max_speed: number;
}

export interface Join {
  a: number;
  b: number;
  radius: number;
  place: Vector;
  by: string;
}

export interface Narrow {
  components: { volume: number; voxels: number; clearance: number; widest: Vector }[];
  joins: Join[];
}
