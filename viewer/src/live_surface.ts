// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import { Reader, type Surface, type Vector } from "./layers";

const kBlock = 8; // voxels a side

/** The obstacles of a map that grows, block by block: what each event of docs/viewer.md changes. */
export class LiveSurface {
  private readonly blocks = new Map<string, { block: Vector; quads: Uint32Array }>();
  private origin: Vector = [0, 0, 0];
  private voxel_size = 1;

  clear(): void {
    this.blocks.clear();
  }

  apply(bytes: ArrayBuffer): void {
    const reader = new Reader(bytes);
    this.origin = reader.origin();
    this.voxel_size = reader.f64();
    const count = reader.u32();
    for (let i = 0; i < count; ++i) {
      const block = [...reader.take(Int32Array, 3)] as Vector;
      const quads = reader.take(Uint32Array, reader.u32());
      // A copy: a view would keep all bytes of its event.
      if (quads.length > 0) this.blocks.set(block.join(), { block, quads: quads.slice() });
      else this.blocks.delete(block.join());
    }
  }

  /** All of it, as one surface. */
  whole(): Surface {
    const low: Vector = [Infinity, Infinity, Infinity];
    const high: Vector = [-Infinity, -Infinity, -Infinity];
    let count = 0;
    for (const { block, quads } of this.blocks.values()) {
      for (let k = 0; k < 3; ++k) {
        low[k] = Math.min(low[k]!, block[k]!);
        high[k] = Math.max(high[k]!, block[k]!);
      }
      count += quads.length;
    }
    const is_wide = high.some((end, k) => kBlock * (end + 1 - low[k]!) > 0xffff);
    const surface: Surface = {
      origin: this.origin.map((x, k) => (count > 0 ? x + kBlock * low[k]! * this.voxel_size : x)) as Vector,
      cell: this.voxel_size,
      cell_voxels: 1,
      count,
      cells: is_wide ? new Uint32Array(4 * count) : new Uint16Array(4 * count),
      sizes: new Uint8Array(4 * count),
    };
    let at = 0;
    for (const { block, quads } of this.blocks.values())
      for (const quad of quads) {
        for (let k = 0; k < 3; ++k) surface.cells[at + k] = kBlock * (block[k]! - low[k]!) + ((quad >> (3 * k)) & 7);
        surface.cells[at + 3] = (quad >> 9) & 7;
        surface.sizes[at] = 1 + ((quad >> 12) & 7);
        surface.sizes[at + 1] = 1 + ((quad >> 15) & 7);
        at += 4;
      }
    return surface;
  }
}
