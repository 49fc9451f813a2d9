// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

// What emscripten makes of viewer/wasm.
declare module "planner" {
  export interface Planner {
    HEAPU8: Uint8Array<ArrayBuffer>;
    FS: { writeFile(path: string, bytes: Uint8Array): void; unlink(path: string): void };
    ccall(name: string, result: "number", types: "string"[], values: string[]): number;
    _planner_bytes(): number;
    _planner_size(): number;
  }
  export default function create_planner(options: { unpack(packed: Uint8Array): Uint8Array }): Promise<Planner>;
}
