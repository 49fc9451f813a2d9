// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import { Reader, type Net, type Vector } from "./layers";

interface Named {
  voxels: number[]; // of a vertex three numbers, of an edge six: voxels of the world's lattice
  clearance: number;
}

/** Takes away what went, and sets what came or has another clearance. */
function apply_part(reader: Reader, parts: Map<string, Named>, length: number): void {
  const gone = reader.u32();
  const came = reader.u32();
  const names = (count: number) => Array.from({ length: count }, () => [...reader.take(Int32Array, length)]);
  for (const name of names(gone)) parts.delete(name.join());
  const come = names(came);
  const clearance = reader.take(Float32Array, came);
  come.forEach((voxels, i) => parts.set(voxels.join(), { voxels, clearance: clearance[i]! }));
}

/** Numbers of the connected components of what pairs join, largest first. */
function components_of(count: number, pairs: Uint32Array): Uint32Array {
  const parent = Uint32Array.from({ length: count }, (_, i) => i);
  const root = (i: number): number => {
    while (parent[i] !== i) i = parent[i] = parent[parent[i]!]!;
    return i;
  };
  for (let i = 0; i < pairs.length; i += 2) parent[root(pairs[i]!)] = root(pairs[i + 1]!);
  const sizes = new Map<number, number>();
  for (let i = 0; i < count; ++i) sizes.set(root(i), (sizes.get(root(i)) ?? 0) + 1);
  const order = [...sizes.keys()].sort((a, b) => sizes.get(b)! - sizes.get(a)!);
  const numbers = new Map(order.map((at, i) => [at, i]));
  return Uint32Array.from({ length: count }, (_, i) => numbers.get(root(i))!);
}

/** The graph of a map that grows: what each event of docs/viewer.md changes. */
export class LiveGraph {
  readonly vertices = new Map<string, Named>();
  readonly edges = new Map<string, Named>();
  private voxel_size = 1;

  clear(): void {
    this.vertices.clear();
    this.edges.clear();
  }

  apply(bytes: ArrayBuffer): void {
    const reader = new Reader(bytes);
    this.voxel_size = reader.f64();
    apply_part(reader, this.vertices, 3);
    apply_part(reader, this.edges, 6);
  }

  /** All of it; positions are from an origin in the world. */
  whole(origin: Vector): Net {
    const numbers = new Map([...this.vertices.keys()].map((name, i) => [name, i]));
    const vertices = [...this.vertices.values()];
    const edges = [...this.edges.values()];
    const pairs = Uint32Array.from(edges.flatMap(({ voxels }) => [voxels.slice(0, 3), voxels.slice(3)].map((end) => numbers.get(end.join())!)));
    return {
      origin,
      positions: Float32Array.from(vertices.flatMap(({ voxels }) => voxels.map((v, k) => (v + 0.5) * this.voxel_size - origin[k]!))),
      clearance: Float32Array.from(vertices, (v) => v.clearance),
      component: components_of(vertices.length, pairs),
      pairs,
      pair_clearance: Float32Array.from(edges, (e) => e.clearance),
    };
  }
}
