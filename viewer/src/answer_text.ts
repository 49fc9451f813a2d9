// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import { kRoutes } from "./colours";
import { swatch } from "./drawings";
import type { Join, PlanAnswer, Route } from "./layers";
import { metres, metres_at_least, metres_at_most, place_text, seconds } from "./numbers";

// Answers in words.

export function join_text(join: Join, volume: (component: number) => string): string {
  const between = join.by === "unknown" ? "between unknown space" : join.by === "limits" ? "within the limits of flights" : "between obstacles";
  return `radius ${metres_at_most(join.radius)} m joins ${volume(join.a)} and ${volume(join.b)}, ${between}`;
}

/** Where no two places are joined by a way that only a smaller robot fits through. */
export function no_joins_text(components: number): string {
  if (components === 0) return "None: a robot fits nowhere.";
  if (components === 1) return "None: all places that a robot fits are connected.";
  return `None: there are ${components} parts, and no smaller robot finds a way between them.`;
}

/** A reason of the command line, for who has a form in place of options. */
function in_words_of_form(reason: string): string {
  return reason
    .replace(", or give --escape to begin or end there", "")
    .replace("give a larger --snap", "give a larger Snap")
    .replace("let --snap do so", "let a larger Snap do so")
    .replace(/let --snap ([\d.]+) do so/, "let a Snap of $1 m do so")
    .replace("give a larger --time-limit, or --iteration-limit where the planner samples", "take the planner graph, or move Start and Goal nearer to each other")
    .replace("give that --radius", "give that Radius")
    .replace("--radius", "Radius")
    .replaceAll("m^3", "m\u00b3");
}

/** What the server calls what stands in a field of the form. */
const kTitles: Record<string, string> = { from: "Start", to: "Goal", radius: "Radius", prefer_clearance: "Prefer clearance", snap: "Snap", alternatives: "Routes", max_speed: "Speed", max_acceleration: "Acceleration" };

/** What is wrong with a query, for who has filled in a form. */
export function error_text(error: unknown): string {
  const { message } = error as Error;
  return message.replace(/^\w+(?= '|:)/, (name) => kTitles[name] ?? name);
}

/** While an end is dragged no reason is asked for. */
const kStatuses: Record<string, string> = {
  start_outside_map: "Start is outside of the map",
  goal_outside_map: "Goal is outside of the map",
  start_unknown: "Start is in unknown space",
  goal_unknown: "Goal is in unknown space",
  start_in_collision: "Start is too near to an obstacle",
  goal_in_collision: "Goal is too near to an obstacle",
  start_outside_limits: "Start is outside of the flight's limits",
  goal_outside_limits: "Goal is outside of the flight's limits",
  no_route: "No route joins Start and Goal at this radius",
  timeout: "Time was up before a route was found",
};

const kPlanners: Record<string, string> = { graph: "the graph", diagram: "the skeleton diagram", esdf: "A* on voxels", theta: "Theta*" };

/** Why there is no route, beginning with what to change. */
export function reason_text(answer: PlanAnswer): string {
  const { blocked, radius, reason } = answer;
  const words = reason ? in_words_of_form(reason) : (kStatuses[answer.status] ?? `No route: ${answer.status.replaceAll("_", " ")}`);
  const full = `${words[0]!.toUpperCase()}${words.slice(1)}`;
  if (!blocked || blocked.radius <= 0 || !blocked.place) return full;
  const narrow = { unknown: "Between unknown space the way is", limits: "Within the limits of flights the way is" }[blocked.by] ?? "The way is";
  return `${narrow} too narrow by ${metres_at_least(Math.max(0.001, radius - blocked.radius))} m at ${place_text(blocked.place)}. ${full}`;
}

/** No more than there is. */
export function clearance_text(clearance: number | null, name = ""): string {
  return clearance === null ? "no obstacle near" : `${name}${metres_at_most(clearance)} m`;
}

export function route_rows(routes: Route[], answer: PlanAnswer): HTMLElement[] {
  const first = routes[0]!;
  const head = document.createElement("p");
  const length = document.createElement("strong");
  length.id = "length";
  length.textContent = `${metres(first.length)} m`;
  head.append(length);
  const table = document.createElement("table");
  const row = (name: string, value: string) => {
    const line = table.insertRow();
    const th = document.createElement("th");
    th.scope = "row";
    th.textContent = name;
    line.append(th);
    line.insertCell().textContent = value;
  };
  row("clearance", clearance_text(first.clearance));
  row("planned in", seconds(answer.seconds.total));
  row("answered by", `${kPlanners[first.answered_by] ?? first.answered_by}, ${first.waypoints.length} waypoints`);
  if (first.within !== undefined) row("shortest", first.within <= 1.0005 ? "there is no shorter one" : `this is at most ${(100 * (first.within - 1)).toFixed(1)} % longer`);
  if (first.moved_start) row("start", `moved by ${metres(first.moved_start.distance)} m`);
  if (first.moved_goal) row("goal", `moved by ${metres(first.moved_goal.distance)} m`);
  routes.slice(1).forEach((route, i) => {
    row(`route ${i + 2}`, `${metres(route.length)} m, ${clearance_text(route.clearance, "clearance ")}`);
    table.rows[table.rows.length - 1]!.cells[0]!.prepend(swatch(kRoutes[(i + 1) % kRoutes.length]!));
  });
  if (routes.length > 1) head.prepend(swatch(kRoutes[0]!));
  if (answer.routes && answer.complete) row("", "the graph has no others");
  return [head, table];
}
