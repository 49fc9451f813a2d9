// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

/** Where answers of docs/viewer.md come from: the server, or the planner in this page. */
export interface MapSource {
  ask(path: string, parameters?: Record<string, string>): Promise<ArrayBuffer>;
}

export class AnswerError extends Error {}

/** `status`: of HTTP. */
function message_of(bytes: ArrayBuffer, status: number): string {
  try {
    return JSON.parse(new TextDecoder().decode(bytes)).error;
  } catch {
    return `the answer cannot be read (HTTP status ${status})`;
  }
}

/** The server that the page came from. Where another map is served at its address later, the page is loaded again: all it shows is of the first. */
export class ServerSource implements MapSource {
  private map: string | null = null; // that the answers are of

  async ask(path: string, parameters: Record<string, string> = {}): Promise<ArrayBuffer> {
    const query = new URLSearchParams(parameters).toString();
    let response: Response;
    try {
      response = await fetch(query ? `${path}?${query}` : path);
    } catch {
      throw new AnswerError("the server does not answer: is `ridgeway` still running?");
    }
    const map = response.headers.get("Ridgeway-Map"); // none where something else answers
    this.map ??= map;
    if (map && map !== this.map) {
      location.reload();
      throw new AnswerError("another map is served at this address now: the page is loaded again");
    }
    const bytes = await response.arrayBuffer();
    if (!response.ok) throw new AnswerError(message_of(bytes, response.status));
    return bytes;
  }
}

/** A source of which some answers have been asked for before they are wanted. */
export class EarlySource implements MapSource {
  private readonly begun = new Map<string, Promise<ArrayBuffer>>();

  constructor(private readonly source: MapSource) {}

  /** Asks, in the order given. */
  begin(...paths: string[]): void {
    for (const path of paths) {
      const answer = this.source.ask(path);
      answer.catch(() => {}); // told to who wants it
      this.begun.set(path, answer);
    }
  }

  ask(path: string, parameters?: Record<string, string>): Promise<ArrayBuffer> {
    const answer = parameters ? undefined : this.begun.get(path);
    if (!answer) return this.source.ask(path, parameters);
    this.begun.delete(path);
    return answer;
  }
}

/** The planner itself, in a worker: the map and the planner stand in the page. */
export class PlannerSource implements MapSource {
  private readonly worker: Worker;
  private readonly waiting = new Map<number, { resolve: (bytes: ArrayBuffer) => void; reject: (error: Error) => void }>();
  private next = 1;

  constructor(worker_base64: string, map_base64: string, name: string) {
    const script = new Blob([bytes_of(worker_base64)], { type: "text/javascript" });
    this.worker = new Worker(URL.createObjectURL(script));
    this.worker.onmessage = (event) => {
      const { id, status, bytes } = event.data;
      const waiting = this.waiting.get(id);
      this.waiting.delete(id);
      if (status === 200) waiting?.resolve(bytes);
      else waiting?.reject(new AnswerError(message_of(bytes, status)));
    };
    this.worker.onerror = (event) => {
      for (const { reject } of this.waiting.values())
        reject(new AnswerError(`the planner has ended: ${event.message}`));
      this.waiting.clear();
    };
    const map = bytes_of(map_base64);
    this.worker.postMessage({ map, name }, [map.buffer]);
  }

  ask(path: string, parameters: Record<string, string> = {}): Promise<ArrayBuffer> {
    return new Promise((resolve, reject) => {
      this.waiting.set(this.next, { resolve, reject });
      this.worker.postMessage({ id: this.next++, path, parameters });
    });
  }
}

export function bytes_of(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** The planner in the page where there is one, else the server. */
export function find_source(): MapSource {
  const worker = document.getElementById("worker");
  const map = document.getElementById("map");
  if (!worker || !map) return new ServerSource();
  const source = new PlannerSource(worker.textContent!.trim(), map.textContent!.trim(), map.dataset.name ?? "map");
  worker.remove();
  map.remove();
  return source;
}

export async function ask_json<T>(source: MapSource, path: string, parameters?: Record<string, string>): Promise<T> {
  return JSON.parse(new TextDecoder().decode(await source.ask(path, parameters)));
}
