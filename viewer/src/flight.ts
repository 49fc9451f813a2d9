// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import { clearance_text, error_text } from "./answer_text";
import { kFlight } from "./colours";
import { element, input } from "./dom";
import type { Flight, Vector } from "./layers";
import type { Legend } from "./legend";
import { metres, place_text } from "./numbers";
import type { Page } from "./page";
import { ask_json } from "./source";

/** Limits of the flight: their fields, and names in the server's questions and on the command line. */
export const kFlightLimits = [
  { id: "speed", name: "Speed", parameter: "max_speed", option: "--max-speed" },
  { id: "acceleration", name: "Acceleration", parameter: "max_acceleration", option: "--max-acceleration" },
];

/** Characters of the path as it stands in the address, of which the server takes 8 KiB. */
const kLongestPath = 7_500;

/** The trajectory along the route, and the drone on it, by a slider for the time. */
export class FlightPanel {
  /** Set where the layer is switched on and off. */
  is_shown: () => boolean = () => true;
  /** Of the last flight that was asked for: when it is there. */
  flown: Promise<void> = Promise.resolve();
  private flight?: Flight;
  private query?: Record<string, string>;
  private waypoints: Vector[] = [];
  private playing = 0;
  private asked = 0; // flights so far: only the last is taken

  constructor(private readonly page: Page) {
    input("time").addEventListener("input", () => {
      this.stop();
      this.set_time(input("time").valueAsNumber);
    });
    element("play").addEventListener("click", () => (this.playing ? this.stop() : this.play()));
    for (const { id } of kFlightLimits) element(id).addEventListener("change", () => this.query && this.fly(this.query, this.waypoints));
  }

  /** Asks for the flight along the route that answers a query: as it is shown, unless it is too long to be asked for. */
  fly(query: Record<string, string>, waypoints: Vector[]): void {
    this.query = query;
    this.waypoints = waypoints;
    const wrong = kFlightLimits.find(({ id }) => Number.isNaN(input(id).valueAsNumber));
    if (wrong) return this.set(undefined, `No trajectory: ${wrong.name} is no number`);
    const { alternatives: _, ...parameters } = query;
    const path = waypoints.map((p) => p.join(",")).join(";");
    const along: Record<string, string> = encodeURIComponent(path).length < kLongestPath ? { path, radius: query.radius! } : parameters;
    const limits = Object.fromEntries(kFlightLimits.map(({ id, parameter }) => [parameter, input(id).value]));
    this.flown = this.ask({ ...along, ...limits });
  }

  /** Whether it is, or will be, the flight along this route that answers a query. */
  is_along(query: Record<string, string>, waypoints: Vector[]): boolean {
    return !!this.query && JSON.stringify([this.query, this.waypoints]) === JSON.stringify([query, waypoints]);
  }

  private async ask(parameters: Record<string, string>): Promise<void> {
    const asked = ++this.asked;
    let flight: Flight | undefined;
    let failure = "";
    try {
      const answer = await ask_json<Flight>(this.page.source, "/api/trajectory", parameters);
      if (answer.status === "ok" && answer.samples.length > 1) flight = answer;
      else if (answer.status === "ok") failure = "No trajectory: start and goal are one place";
      else failure = `No trajectory: ${answer.reason ?? answer.status.replaceAll("_", " ")}`;
    } catch (error) {
      failure = error_text(error);
    }
    if (asked !== this.asked) return;
    if (flight && JSON.stringify(flight) === JSON.stringify(this.flight)) return; // it goes on
    this.set(flight, failure);
  }

  clear(): void {
    ++this.asked;
    this.query = undefined;
    if (!element("flight").hidden) this.set(undefined);
  }

  explain(legend: Legend): void {
    if (this.flight && this.is_shown()) legend.mark(`Trajectory, ${metres(this.flight.duration, 2)} s`, kFlight);
  }

  /** Where there is a failure, its words stand in place of the flight; the limits can still be changed. */
  private set(flight: Flight | undefined, failure = ""): void {
    this.stop();
    this.flight = flight;
    this.page.routes.show_flight(flight);
    if (!this.is_shown()) this.page.routes.flight_group.visible = false;
    element("flight").hidden = !flight && !failure;
    element("flight-time").hidden = element("play").hidden = !flight;
    element("no-flight").textContent = failure;
    element("state").textContent = "";
    if (flight) {
      input("time").max = String(flight.duration);
      input("time").value = "0";
      this.set_time(0);
    }
    this.page.update_legend();
  }

  private set_time(time: number): void {
    const state = this.page.routes.set_time(time);
    if (!state || !this.flight) return;
    input("time").value = String(time);
    const text = `${time.toFixed(1)} of ${this.flight.duration.toFixed(1)} s`;
    element("clock").textContent = text;
    input("time").setAttribute("aria-valuetext", text);
    element("state").textContent = `${Math.hypot(...state.velocity).toFixed(2)} m/s at ${place_text(state.position)}; ${clearance_text(this.flight.clearance, "clearance at least ")}`;
  }

  private play(): void {
    if (!this.flight) return;
    const at = input("time").valueAsNumber;
    const from = at >= this.flight.duration - 0.05 ? 0 : at;
    const started = performance.now();
    this.page.stage.moves_over(true);
    element("play").setAttribute("aria-pressed", "true");
    element("play").textContent = "Stop";
    const step = () => {
      const now = Math.min(this.flight!.duration, from + (performance.now() - started) / 1000);
      this.set_time(now);
      if (now < this.flight!.duration) this.playing = requestAnimationFrame(step);
      else this.stop();
    };
    this.playing = requestAnimationFrame(step);
  }

  private stop(): void {
    if (this.playing) this.page.stage.moves_over(false);
    cancelAnimationFrame(this.playing);
    this.playing = 0;
    element("play").setAttribute("aria-pressed", "false");
    element("play").textContent = "Fly";
  }
}
