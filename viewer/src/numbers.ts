// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import type { Vector } from "./layers";

/** A word as a shell takes it. */
export function shell_word(word: string): string {
  return /^[\w./+-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

/** Metres as the command line prints them: three decimals at most, no zeros behind. */
export function metres(value: number, decimals = 3): string {
  return String(Number(value.toFixed(decimals)));
}

/** Metres by which a value may be off for rounding alone. */
const kRounding = 1e-6;

/** What fits: metres that are no more than a value. */
export function metres_at_most(value: number, decimals = 3): string {
  const scale = 10 ** decimals;
  return metres(Math.floor((value + kRounding) * scale) / scale, decimals);
}

/** What is needed: metres that are no less than a value. */
export function metres_at_least(value: number, decimals = 3): string {
  const scale = 10 ** decimals;
  return metres(Math.ceil((value - kRounding) * scale) / scale, decimals);
}

export function place_text(place: Vector): string {
  return place.map((x) => metres(x)).join(",");
}

/** "x, y, z", commas or blanks between, in brackets or not; nothing for what is no place. `layer`: the z of "x, y". */
export function place_of(text: string, layer?: number): Vector | undefined {
  const parts = text.replace(/^\s*[([]|[)\]]\s*$/g, "").trim().split(/[\s,;]+/).filter(Boolean).map(Number);
  if (parts.length === 2 && layer !== undefined) parts.push(layer);
  return parts.length === 3 && parts.every(Number.isFinite) ? (parts as Vector) : undefined;
}

/** "1 edge", "1,234 edges". */
export function counted(count: number, one: string, many: string): string {
  return `${count.toLocaleString("en")} ${count === 1 ? one : many}`;
}

/** Cubic metres; small parts of space have some too. */
export function volume_text(value: number): string {
  return value < 0.001 ? "less than 0.001 m³" : `${metres(value, value < 1 ? 3 : 1)} m³`;
}

export function seconds(value: number): string {
  if (value === 0) return "less than 0.1 ms"; // a page's clock is coarse
  if (value < 1e-3) return `${Number((1e6 * value).toPrecision(3))} µs`;
  if (value < 1) return `${Number((1e3 * value).toPrecision(3))} ms`;
  return `${value.toPrecision(3)} s`;
}
