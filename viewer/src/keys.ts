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

/** Letters are typed into it, or choose in it. */
function takes_letters(target: HTMLElement): boolean {
  if (target instanceof HTMLInputElement) return target.type !== "checkbox" && target.type !== "range";
  return target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;
}

function press(event: KeyboardEvent, stage: Stage, pointing: Pointing): void {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const target = event.target as HTMLElement;
  if (takes_letters(target)) {
    if (event.key === "Escape") element("canvas").focus();
    return;
  }
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key; // also with Shift and Caps Lock
  const tool = kTools[key];
  if (tool) {
    if (key === "Escape") {
      pointing.take_back();
      pointing.clear_measured();
    }
    return pointing.use(tool);
  }
  if (key === "t") return stage.look_from_above();
  if (key === "o") return stage.look_from_side();
  const turn = kTurns[key];
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
