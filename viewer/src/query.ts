// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import { error_text, reason_text, route_rows } from "./answer_text";
import { kGoal, kNarrow, kRoutes, kStart } from "./colours";
import { element, input } from "./dom";
import { type FlightPanel, kFlightLimits } from "./flight";
import type { PlanAnswer, Route, Vector } from "./layers";
import type { Legend } from "./legend";
import { metres, place_of, place_text, shell_word } from "./numbers";
import type { Page } from "./page";
import { ask_json } from "./source";

type End = "start" | "goal";
/** Seconds after which a plan is given up (view/map_answers.cpp). */
const kLongestPlan = 10;
const kEnds: readonly End[] = ["start", "goal"];
const kFields = { start: "from", goal: "to" } as const;
const kTitles = { start: "Start", goal: "Goal" } as const;
const kNoPlace = "three numbers: x, y, z";
const kNumbers = { radius: "Radius", alternatives: "Routes", prefer: "Prefer clearance", snap: "Snap" } as const;
/** Fields that the address of the page has, for links and for when it is loaded again. */
const kRecalled = ["from", "to", "radius", "planner", "alternatives", "prefer", "snap", ...kFlightLimits.map(({ id }) => id)];
/** Milliseconds without an answer: then the last one must not stay for it. */
const kPatience = 250;

/** As it is asked. */
type Query = Record<string, string>;

/** What a field holds at first; a choice, which has no such attribute, its first. */
function initial_of(id: string): string {
  return input(id).defaultValue ?? element<HTMLSelectElement>(id).options[0]!.value;
}

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
  private asked = ""; // what it asks, where all is wanted
  private reasoned = ""; // question and status of the answer whose reason stands there
  private wanted: "nothing" | "route" | "all" = "nothing"; // of the next
  private blocked_place?: Vector;
  private asked_last?: [Query, string]; // with the status of the answer that is shown
  private unwritten?: End; // moved, and not yet in the form

  constructor(private readonly page: Page, private readonly flight: FlightPanel, fly_to: (place: Vector) => void) {
    this.recall();
    if (!input("radius").value) input("radius").value = String(page.info.min_clearance); // rounded it may be less than the map was built for
    input("radius").min = String(page.info.min_clearance);
    page.routes.set_radius(this.radius);
    page.stage.after_frame.push(() => this.write_end());
    for (const end of kEnds) input(kFields[end]).addEventListener("change", () => this.take_typed(end));
    for (const id of ["planner", ...Object.keys(kNumbers)])
      element(id).addEventListener("change", () => {
        if (!input("radius").value && !input("radius").validity.badInput) input("radius").value = String(page.info.min_clearance);
        page.routes.set_radius(this.radius);
        this.fit_form();
        void this.plan();
      });
    for (const { id } of kFlightLimits)
      element(id).addEventListener("change", () => {
        if (!this.asked_last) return;
        this.remember();
        this.show_commands(...this.asked_last);
      });
    element("query").addEventListener("submit", (event) => {
      event.preventDefault();
      const missing = kEnds.find((end) => !this[end]);
      if (missing) this.refuse(this.fault() || `${kTitles[missing]} is missing: click on the map, or type ${kNoPlace}`);
      else if (this.asked !== JSON.stringify(this.query())) void this.plan(); // a field that was left has asked already
    });
    this.fit_form();
    element("show-place").addEventListener("click", () => this.blocked_place && fly_to(this.blocked_place));
    for (const id of Object.keys(kNumbers)) input(id).addEventListener("input", () => this.mark(input(id), input(id).validity.badInput));
  }

  /** Where none is given, that of the smallest robot. */
  get radius(): number {
    const { valueAsNumber } = input("radius");
    return Number.isNaN(valueAsNumber) ? this.page.info.min_clearance : valueAsNumber;
  }

  /** Only the graph has other routes to offer. */
  private fit_form(): void {
    input("alternatives").disabled = input("planner").value !== "graph";
  }

  private take_typed(end: End): void {
    const text = input(kFields[end]).value.trim();
    const { layer } = this.page;
    const place = place_of(text, layer);
    if (place && layer !== undefined) place[2] = layer; // the others are none of the map's
    this.mark_field(end, text && !place ? kNoPlace : "");
    this.set_end(end, place);
    void this.plan();
  }

  /** Puts the question of the address into fields that nobody has touched. */
  private recall(): void {
    const asked = new URLSearchParams(location.hash.slice(1));
    if (asked.get("map") !== this.page.info.name) return;
    for (const id of kRecalled) {
      const value = asked.get(id);
      if (value !== null && input(id).value === initial_of(id)) input(id).value = value;
    }
    if (!input("planner").value) input("planner").value = initial_of("planner"); // there is no such planner
    if (Number(input("radius").value) < this.page.info.min_clearance) input("radius").value = ""; // built anew since
  }

  private remember(): void {
    const asked = new URLSearchParams({ map: this.page.info.name });
    for (const id of kRecalled) if (input(id).value !== initial_of(id)) asked.set(id, input(id).value);
    location.replace(`#${asked}`);
  }

  /** Takes what stands in the form before there is a map. */
  take_form(): void {
    for (const end of kEnds) if (!this[end] && input(kFields[end]).value) this.take_typed(end);
  }

  /** `fault`: what should stand there instead. */
  private mark_field(end: End, fault: string): void {
    const field = input(kFields[end]);
    field.setCustomValidity(fault);
    this.mark(field, !!fault);
  }

  private mark(field: HTMLInputElement, is_wrong: boolean): void {
    if (is_wrong) field.setAttribute("aria-invalid", "true");
    else field.removeAttribute("aria-invalid");
  }

  /** What is wrong with what was typed. */
  private fault(): string {
    const end = kEnds.find((end) => input(kFields[end]).validity.customError);
    if (end) return `${kTitles[end]} is no place: give ${kNoPlace}`;
    const wrong = Object.entries(kNumbers).find(([id]) => input(id).validity.badInput);
    return wrong ? `${wrong[1]} is no number` : "";
  }

  /** Sets an end, for the form and the picture. */
  set_end(which: End, place: Vector | undefined): void {
    this[which] = place;
    this.unwritten = which;
    if (place) this.mark_field(which, "");
    const awaits_route = this.is_dragging && !!this.start && !!this.goal;
    this.page.routes.set_end(which, place, awaits_route);
    // A word that changes is a frame of the whole page, which the frame with the route would wait for.
    if (!awaits_route) this.write_end();
    if (this.is_dragging) return;
    if (this.start && this.goal) return this.page.update_legend();
    this.wanted = "nothing";
    this.refuse(this.fault());
  }

  private write_end(): void {
    const which = this.unwritten;
    this.unwritten = undefined;
    const place = which && this[which];
    if (place) input(kFields[which]).value = place_text(place).replaceAll(",", ", ");
  }

  /**
   * Plans; while one is under way the next waits, and of those that wait only the last is asked.
   * `is_quick`: neither a reason nor a trajectory is wanted.
   */
  async plan(is_quick = this.is_dragging): Promise<void> {
    if (!this.start || !this.goal) return;
    const fault = this.fault();
    if (fault) {
      this.wanted = "nothing";
      return this.refuse(fault);
    }
    if (!is_quick || this.wanted === "nothing") this.wanted = is_quick ? "route" : "all";
    if (this.asking) return;
    this.asking = true;
    try {
      while (this.wanted !== "nothing") {
        const is_route_enough = this.wanted === "route";
        this.wanted = "nothing";
        const query = this.query();
        this.asked = is_route_enough ? "" : JSON.stringify(query);
        await this.plan_once(query, is_route_enough);
      }
    } finally {
      this.asking = false;
      this.asked = "";
    }
    document.body.dataset.planned = String(Number(document.body.dataset.planned ?? 0) + 1);
  }

  explain(legend: Legend, are_routes_shown: boolean): void {
    if (this.start) legend.mark("Start", kStart);
    if (this.goal) legend.mark("Goal", kGoal);
    if (this.blocked_place) legend.mark("Too narrow: the radius that it lets through", kNarrow);
    if (!are_routes_shown) return;
    const several = this.shown.length > 1;
    this.shown.forEach((route, i) => legend.mark(`Route ${several ? `${i + 1}, ` : ""}${metres(route.length, 2)} m`, kRoutes[i % kRoutes.length]!));
  }

  /** A flight is asked for, and not waited for: meanwhile others can be planned. */
  private async plan_once(query: Query, is_quick: boolean): Promise<void> {
    const started = performance.now();
    const waiting = window.setTimeout(() => this.start && this.goal && !this.fault() && this.refuse("Planning ...", "waiting"), kPatience);
    try {
      const answer = await ask_json<PlanAnswer>(this.page.source, "/api/plan", is_quick ? { ...query, explain: "0" } : query);
      window.clearTimeout(waiting);
      this.answer_time = performance.now() - started;
      if (!this.start || !this.goal || this.fault()) return; // taken away since, or asked otherwise
      this.show(answer, query, is_quick);
      if (!is_quick) this.remember();
      if (!is_quick) element("result").scrollIntoView({ block: "nearest" }); // below the form on narrow screens
      const first = this.shown[0];
      if (first && !is_quick && this.wanted === "nothing") this.flight.fly(query, first.waypoints);
    } catch (error) {
      window.clearTimeout(waiting);
      if (this.start && this.goal && !this.fault()) this.refuse(error_text(error));
    }
  }

  /** What the form asks, where both ends are there. */
  private query(): Query {
    const value = (id: string) => input(id).value;
    const query: Query = { from: place_text(this.start!), to: place_text(this.goal!), radius: String(this.radius), planner: value("planner"), prefer_clearance: value("prefer"), snap: value("snap") };
    const routes = value("alternatives");
    if (value("planner") === "graph" && routes && Number(routes) !== 1) query.alternatives = routes;
    return query;
  }

  /** There is no answer to what the form asks now, and what answered an earlier question must not stay for one. */
  private refuse(text: string, kind = "bad"): void {
    this.shown = [];
    this.reasoned = "";
    this.block(undefined);
    this.page.routes.show_routes([]);
    this.flight.clear();
    element("show-place").hidden = true;
    this.asked_last = undefined;
    element("command").textContent = element("flight-command").textContent = "";
    this.offer(undefined);
    this.show_line(text, kind);
    this.page.update_legend();
  }

  /** Where the way is too narrow. */
  private block(blocked: PlanAnswer["blocked"]): void {
    this.blocked_place = blocked?.place ?? undefined;
    this.page.routes.set_blocked(this.blocked_place, blocked?.radius ?? 0);
  }

  /** A quick answer leaves the reason and the flight that are there, where it is the same as the one before. */
  private show(answer: PlanAnswer, query: Query, is_quick: boolean): void {
    const routes = answer.routes ?? (answer.status === "ok" ? [answer as Route] : []);
    const question = JSON.stringify([query, answer.status]);
    if (is_quick && routes.length === 0 && this.reasoned === question) return;
    this.reasoned = is_quick ? "" : question;
    this.shown = routes;
    this.page.routes.show_routes(routes);
    if (!routes[0] || !this.flight.is_along(query, routes[0].waypoints)) this.flight.clear();
    this.page.stage.answered(); // the picture first: it is drawn while the words are set
    this.block(answer.blocked);
    element("show-place").hidden = !this.blocked_place;
    this.asked_last = [query, answer.status];
    this.show_commands(query, answer.status);
    this.offer(routes[0]);
    if (routes.length === 0) this.show_line(reason_text(answer), "bad");
    else element("result").replaceChildren(...route_rows(routes, answer));
    this.page.update_legend();
  }

  private show_line(text: string, kind: string): void {
    element("result").replaceChildren();
    if (!text) return;
    const line = document.createElement("p");
    line.className = kind;
    line.textContent = text;
    element("result").append(line);
  }

  /** The waypoints of a route as a file, as `plan -o` writes them: `trajectory --path` takes it. */
  private offer(route: Route | undefined): void {
    const link = element<HTMLAnchorElement>("save-route");
    URL.revokeObjectURL(link.href);
    link.hidden = !route;
    if (!route) return link.removeAttribute("href");
    const lines = ["x,y,z", ...route.waypoints.map((p) => p.join(","))];
    link.href = URL.createObjectURL(new Blob([`${lines.join("\n")}\n`], { type: "text/csv" }));
  }

  /** The same questions on the command line: for the route, and where there is one for the flight along it. */
  private show_commands(parameters: Query, status: string): void {
    const { name } = this.page.info;
    const map = shell_word(name.startsWith("-") ? `./${name}` : name);
    const ends = `--from=${parameters.from} --to=${parameters.to}`;
    const robot = `--radius ${parameters.radius}`;
    const shared = [];
    if (Number(parameters.prefer_clearance) > 0) shared.push(`--prefer-clearance ${parameters.prefer_clearance}`);
    if (Number(parameters.snap) > 0) shared.push(`--snap ${parameters.snap}`);
    const own = [];
    if (parameters.planner !== "graph") own.push(`--planner ${parameters.planner}`);
    if (parameters.alternatives) own.push(`--alternatives ${parameters.alternatives}`);
    if (status === "timeout") own.push(`--time-limit ${kLongestPlan}`);
    element("command").textContent = ["ridgeway plan", map, ends, robot, ...shared, ...own].join(" ");
    const limits = kFlightLimits.map(({ id, option }) => `${option} ${input(id).value}`);
    const flown = own.length > 0 ? ["--path route.csv", robot] : [ends, robot, ...shared]; // the route as it was saved
    element("flight-command").textContent = status === "ok" ? ["ridgeway trajectory", map, ...flown, ...limits].join(" ") : "";
  }
}
