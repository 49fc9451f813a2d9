// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import { element } from "./dom";
import type { Pointing, Tool } from "./pointing";
import type { Stage } from "./stage";

const kTools: Record<string, Tool> = { s: "start", g: "goal", m: "measure", Escape: "look" };
const kTurn = 0.12; // radians
/** To the right, up, and how much farther. */
const kTurns: Record<string, [number, number, number]> = {
  ArrowLeft: [-kTurn, 0, 1], ArrowRight: [kTurn, 0, 1], ArrowUp: [0, kTurn, 1], ArrowDown: [0, -kTurn, 1],
  "+": [0, 0, 0.85], "=": [0, 0, 0.85], "-": [0, 0, 1 / 0.85],
};

function press(event: KeyboardEvent, stage: Stage, pointing: Pointing): void {
  if (event.ctrlKey || event.metaKey) return;
  const target = event.target as HTMLElement;
  if (target instanceof HTMLInputElement || target instanceof HTMLSelectElement) {
    if (event.key === "Escape") element("canvas").focus();
    return;
  }
  const tool = kTools[event.key];
  if (tool) {
    if (event.key === "Escape") pointing.clear_measured();
    return pointing.use(tool);
  }
  if (event.key === "t") return stage.look_from_above();
  if (event.key === "o") return stage.look_from_side();
  const turn = kTurns[event.key];
  if (!turn || (target.id !== "canvas" && target !== document.body)) return;
  event.preventDefault();
  stage.turn(...turn);
}

/** Keys and buttons that move the view and choose what a click does. */
export function connect_keys(stage: Stage, pointing: Pointing): void {
  element("orbit").addEventListener("click", () => stage.look_from_side());
  element("top").addEventListener("click", () => stage.look_from_above());
  document.addEventListener("keydown", (event) => press(event, stage, pointing));
}
