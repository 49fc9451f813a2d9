// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

export type Rgb = [number, number, number]; // 0 to 1

/** Colours at equal shares of a ramp; between them they are mixed. */
export type Ramp = readonly Rgb[];

function hex(text: string): Rgb {
  const value = parseInt(text, 16);
  return [(value >> 16) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255];
}

/** Of obstacles by height: quiet, so that what is drawn over them stands out. */
export const kHeights: Ramp = ["5a6f8c", "7d92a6", "a8b3b5", "c9c0ab", "dcc59c"].map(hex);
/** Of obstacles where they are cut: far from the ground, which is dark or light as the system is. */
const kSections = { light: hex("3a4450"), dark: hex("c3ccd4") };
export const kDark = "(prefers-color-scheme: dark)";
export function section_colour(): Rgb {
  return matchMedia(kDark).matches ? kSections.dark : kSections.light;
}
/** Of clearance: narrow is red, wide is blue. */
export const kClearances: Ramp = ["d7302f", "f4883c", "f2d24b", "7cc67a", "2f9fb4", "3b5fc0"].map(hex);

export function colour_at(ramp: Ramp, share: number): Rgb {
  const x = Math.min(1, Math.max(0, share)) * (ramp.length - 1);
  const i = Math.min(ramp.length - 2, Math.floor(x));
  const [a, b] = [ramp[i]!, ramp[i + 1]!];
  return [0, 1, 2].map((k) => a[k]! + (b[k]! - a[k]!) * (x - i)) as Rgb;
}

export function css_of([r, g, b]: Rgb): string {
  return `rgb(${Math.round(255 * r)} ${Math.round(255 * g)} ${Math.round(255 * b)})`;
}

export function css_ramp(ramp: Ramp): string {
  return `linear-gradient(to right, ${ramp.map(css_of).join(", ")})`;
}

/** Neighbouring numbers get colours far apart (steps of the golden angle). */
export function component_colour(component: number): Rgb {
  const hue = (component * 137.508 + 210) % 360;
  const lightness = 0.55 - 0.12 * (Math.floor(component / 3) % 2);
  const channel = (n: number): number => {
    const k = (n + hue / 30) % 12;
    return lightness - 0.75 * Math.min(lightness, 1 - lightness) * Math.max(-1, Math.min(k - 3, 9 - k, 1));
  };
  return [channel(0), channel(8), channel(4)];
}

/** Of routes, the shortest first. */
export const kRoutes: readonly Rgb[] = ["e6007e", "7b3ff2", "008f5a", "c75b00", "0077c8", "8a6d00", "b00020", "00828f"].map(hex);
export const kStart: Rgb = hex("0a8f3c");
export const kGoal: Rgb = hex("c8102e");
export const kFlight: Rgb = hex("ffb000");
export const kNarrow: Rgb = hex("e02b20");
export const kMeasure: Rgb = hex("0b63c5");
/** Of a drone that maps, the way that it came, and the way that it flies next. */
export const kDrone: Rgb = hex("d94801");
export const kAhead: Rgb = hex("12a36b");
