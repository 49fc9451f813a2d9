// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import { decompress } from "fzstd";
import create_planner, { type Planner } from "planner";

interface Load {
  map: Uint8Array;
  name: string;
}
interface Ask {
  id: number;
  path: string;
  parameters: Record<string, string>;
}

/** The planner, once it has read the map. */
let planner: Planner | undefined;
let failure: Uint8Array | undefined;
const waiting: Ask[] = [];

function bytes_of_answer(module: Planner): Uint8Array<ArrayBuffer> {
  const at = module._planner_bytes();
  return module.HEAPU8.slice(at, at + module._planner_size());
}

function bytes_of_error(error: string): Uint8Array<ArrayBuffer> {
  return new TextEncoder().encode(JSON.stringify({ error }));
}

function answer({ id, path, parameters }: Ask): void {
  let status = 500;
  let bytes = failure?.slice() ?? new Uint8Array();
  try {
    if (planner) {
      status = planner.ccall("planner_ask", "number", ["string", "string"], [path, JSON.stringify(parameters)]);
      bytes = bytes_of_answer(planner);
    }
  } catch (error) {
    status = 500;
    bytes = bytes_of_error(`the planner has ended: ${error}`);
  }
  postMessage({ id, status, bytes: bytes.buffer }, { transfer: [bytes.buffer] });
}

async function load({ map, name }: Load): Promise<void> {
  try {
    const module = await create_planner({ unpack: (packed: Uint8Array) => decompress(packed) });
    module.FS.writeFile("/map.ridge", map);
    const status = module.ccall("planner_load", "number", ["string", "string"], ["/map.ridge", name]);
    if (status === 200) planner = module;
    else failure = bytes_of_answer(module);
    module.FS.unlink("/map.ridge");
  } catch (error) {
    failure = bytes_of_error(`the planner cannot start: ${error}`);
  }
  for (const ask of waiting.splice(0)) answer(ask);
}

onmessage = (event: MessageEvent<Load | Ask>) => {
  if ("map" in event.data) void load(event.data);
  else if (planner || failure) answer(event.data);
  else waiting.push(event.data);
};
