// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import { reason_text, route_rows } from "./answer_text";
import { kGoal, kRoutes, kStart } from "./colours";
import { element, input } from "./dom";
import type { FlightPanel } from "./flight";
import type { PlanAnswer, Route, Vector } from "./layers";
import type { Legend } from "./legend";
import { metres, place_of, place_text, shell_word } from "./numbers";
import type { Page } from "./page";
import { ask_json } from "./source";

/** The question for a route, and its answer. */
export class QueryPanel {
  start?: Vector;
  goal?: Vector;
  /** While an end is dragged there are neither reasons nor trajectories, which take longer. */
  is_dragging = false;
  shown: Route[] = [];
  /** For measurements: of the last plan, milliseconds from the question to the answer. */
  answer_time = 0;
  private asking = false; // a plan is under way
  private wanted: "nothing" | "route" | "all" = "nothing"; // of the next
  private blocked_place?: Vector;
  private unwritten?: "start" | "goal"; // moved, and not yet in the form

  constructor(private readonly page: Page, private readonly flight: FlightPanel, fly_to: (place: Vector) => void) {
    input("radius").value = metres(page.info.min_clearance);
    page.routes.set_radius(this.radius);
    page.stage.after_frame.push(() => this.write_end());
    for (const id of ["from", "to"] as const)
      input(id).addEventListener("change", () => {
        this.set_end(id === "from" ? "start" : "goal", place_of(input(id).value));
        void this.plan();
      });
    for (const id of ["radius", "planner", "alternatives", "prefer", "snap"])
      element(id).addEventListener("change", () => {
        page.routes.set_radius(this.radius);
        void this.plan();
      });
    element("query").addEventListener("submit", (event) => {
      event.preventDefault();
      void this.plan();
    });
    element("show-place").addEventListener("click", () => this.blocked_place && fly_to(this.blocked_place));
  }

  get radius(): number {
    return input("radius").valueAsNumber || this.page.info.min_clearance;
  }

  /** Sets an end, for the form and the picture. */
  set_end(which: "start" | "goal", place: Vector | undefined): void {
    this[which] = place;
    this.unwritten = which;
    const awaits_route = this.is_dragging && !!this.start && !!this.goal;
    this.page.routes.set_end(which, place, awaits_route);
    // A word that changes is a frame of the whole page, which the frame with the route would wait for.
    if (!awaits_route) this.write_end();
    if (!this.is_dragging) this.page.update_legend();
  }

  private write_end(): void {
    const which = this.unwritten;
    this.unwritten = undefined;
    const place = which && this[which];
    if (place) input(which === "start" ? "from" : "to").value = place_text(place).replaceAll(",", ", ");
  }

  /**
   * Plans; while one is under way the next waits, and of those that wait only the last is asked.
   * `is_quick`: neither a reason nor a trajectory is wanted.
   */
  async plan(is_quick = this.is_dragging): Promise<void> {
    if (!this.start || !this.goal) return;
    if (!is_quick || this.wanted === "nothing") this.wanted = is_quick ? "route" : "all";
    if (this.asking) return;
    this.asking = true;
    while (this.wanted !== "nothing") {
      const is_route_enough = this.wanted === "route";
      this.wanted = "nothing";
      await this.plan_once(is_route_enough);
    }
    this.asking = false;
    document.body.dataset.planned = String(Number(document.body.dataset.planned ?? 0) + 1);
  }

  explain(legend: Legend, are_routes_shown: boolean): void {
    if (this.start) legend.mark("Start", kStart);
    if (this.goal) legend.mark("Goal", kGoal);
    if (!are_routes_shown) return;
    const several = this.shown.length > 1;
    this.shown.forEach((route, i) => legend.mark(`Route ${several ? `${i + 1}, ` : ""}${metres(route.length, 2)} m`, kRoutes[i % kRoutes.length]!));
  }

  private async plan_once(is_quick: boolean): Promise<void> {
    const started = performance.now();
    const parameters = this.parameters();
    try {
      const answer = await ask_json<PlanAnswer>(this.page.source, "/api/plan", is_quick ? { ...parameters, explain: "0" } : parameters);
      this.answer_time = performance.now() - started;
      this.show(answer);
      const first = this.shown[0];
      if (first && !is_quick && this.wanted === "nothing") await this.flight.fly(parameters, first.waypoints);
    } catch (error) {
      this.show_failure((error as Error).message);
    }
  }

  private parameters(): Record<string, string> {
    const value = (id: string) => input(id).value;
    const parameters: Record<string, string> = { from: place_text(this.start!), to: place_text(this.goal!), radius: value("radius"), planner: value("planner"), prefer_clearance: value("prefer"), snap: value("snap") };
    if (Number(value("alternatives")) > 1 && value("planner") === "graph") parameters.alternatives = value("alternatives");
    return parameters;
  }

  private show(answer: PlanAnswer): void {
    const routes = answer.routes ?? (answer.status === "ok" ? [answer as Route] : []);
    this.shown = routes;
    this.page.routes.show_routes(routes);
    this.flight.clear();
    this.page.stage.answered(); // the picture first: it is drawn while the words are set
    this.blocked_place = answer.blocked?.place ?? undefined;
    element("show-place").hidden = !this.blocked_place;
    element("command").textContent = this.command();
    if (routes.length === 0) this.show_failure(reason_text(answer));
    else element("result").replaceChildren(...route_rows(routes, answer));
    this.page.update_legend();
  }

  private show_failure(text: string): void {
    const line = document.createElement("p");
    line.className = "bad";
    line.textContent = text;
    element("result").replaceChildren(line);
  }

  /** The same question on the command line. */
  private command(): string {
    const parameters = this.parameters();
    const words = ["ridgeway plan", shell_word(this.page.info.name), `--from=${parameters.from}`, `--to=${parameters.to}`, `--radius ${parameters.radius}`];
    if (parameters.planner !== "graph") words.push(`--planner ${parameters.planner}`);
    if (Number(parameters.prefer_clearance) > 0) words.push(`--prefer-clearance ${parameters.prefer_clearance}`);
    if (Number(parameters.snap) > 0) words.push(`--snap ${parameters.snap}`);
    if (parameters.alternatives) words.push(`--alternatives ${parameters.alternatives}`);
    return words.join(" ");
  }
}
