// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";
import { element, input } from "./dom";
import { SliceDrawing } from "./drawings";
import { read_section, read_slice } from "./layers";
import { metres } from "./numbers";
import type { Page } from "./page";
import { SectionDrawing } from "./section";
import type { Hit } from "./surface";

const kPause = 2000, kLongestPause = 60_000; // milliseconds

/** The sliders: where obstacles are cut off, and where distances are shown. */
export class HeightPanel {
  readonly slice = new SliceDrawing();
  /** Set where the slice is switched on and off. */
  is_slice_shown: () => boolean = () => false;
  show_slice_layer: () => void = () => {};
  /** When the section of the last cut is there. */
  sectioned: Promise<void> = Promise.resolve();
  private readonly section = new SectionDrawing();
  private is_cut_chosen = false;
  private is_slice_wanted = false;
  private is_slice_asked = false;
  private failure = ""; // what is said where the slice could not be had
  private again = 0; // the section is asked for again after the pause, where it could not be had
  private pause = kPause;
  private is_section_wanted = false;
  private is_section_asked = false;

  constructor(private readonly page: Page) {
    this.set_range();
    input("slice").value = String(page.surface.low + Math.min((page.surface.high - page.surface.low) / 2, 1));
    input("cut").addEventListener("input", () => {
      this.cut_at(input("cut").valueAsNumber);
    });
    input("slice").addEventListener("input", () => {
      this.tell();
      if (this.is_slice_shown()) void this.show_slice();
      else this.show_slice_layer();
    });
    this.tell();
    page.surface.mesh.add(this.section.mesh);
    this.cut_anew();
  }

  /** What a ray meets first: a face, or an obstacle where it is cut. */
  hit(ray: THREE.Ray): Hit | undefined {
    const { surface } = this.page;
    const hit = surface.hit(ray);
    const distance = (surface.cut - ray.origin.z) / ray.direction.z;
    if (!(ray.direction.z < 0 && distance > 0) || (hit && hit.distance <= distance)) return hit;
    const place = ray.at(distance, new THREE.Vector3());
    if (!this.section.covers(place.x, place.y)) return hit;
    return { distance, place, normal: new THREE.Vector3(0, 0, 1), is_cut: true };
  }

  /** Metres from the map's lowest corner. */
  cut_at(height: number): void {
    this.is_cut_chosen = true;
    this.page.surface.cut = height;
    input("cut").value = String(height);
    this.tell();
    this.page.stage.changed();
    this.cut_anew();
  }

  /** The map reaches elsewhere now. A cut that nobody has chosen follows its ceilings. */
  follow(): void {
    const { surface } = this.page;
    if (!this.is_cut_chosen) surface.cut = surface.height_below_ceilings(this.page.stage.size.x * this.page.stage.size.y);
    this.set_range();
    this.tell();
    this.cut_anew();
  }

  private cut_anew(): void {
    this.section.mesh.position.z = this.page.surface.cut; // meanwhile what is known of the cut before
    this.is_section_wanted = true;
    if (!this.is_section_asked) this.sectioned = this.show_section();
  }

  /** Asks for where obstacles are cut; of those that wait only the last is asked. */
  private async show_section(): Promise<void> {
    const { page, section } = this;
    this.is_section_asked = true;
    while (this.is_section_wanted) {
      this.is_section_wanted = false;
      try {
        section.show(read_section(await page.source.ask("/api/section", { z: String(page.base.z + page.surface.cut) })), page.base);
        this.pause = kPause;
      } catch {
        section.mesh.visible = false; // the picture is as good as it can be without
        window.clearTimeout(this.again);
        this.again = window.setTimeout(() => this.cut_anew(), this.pause);
        this.pause = Math.min(2 * this.pause, kLongestPause);
      }
      page.stage.changed();
    }
    this.is_section_asked = false;
  }

  /** Asks for the slice, of the map as it is now; of those that wait only the last is asked. */
  async show_slice(): Promise<void> {
    if (!this.is_slice_shown()) return;
    this.is_slice_wanted = true;
    if (this.is_slice_asked) return;
    const { page } = this;
    this.is_slice_asked = true;
    while (this.is_slice_wanted) {
      this.is_slice_wanted = false;
      try {
        const bytes = await page.source.ask("/api/slice", { z: String(page.base.z + input("slice").valueAsNumber) });
        this.slice.show(read_slice(bytes), page.base, page.scale);
        if (this.failure && element("hint").textContent === this.failure) page.hint("");
        this.failure = "";
      } catch (error) {
        this.slice.clear();
        this.failure = (error as Error).message;
        page.hint(this.failure);
      }
      page.stage.changed();
    }
    this.is_slice_asked = false;
  }

  private set_range(): void {
    const { surface, info } = this.page;
    const step = info.voxel_size;
    const set = (id: string, max: number) => Object.assign(input(id), { min: String(surface.low), max: String(max), step: String(step) });
    set("cut", surface.high + step);
    set("slice", surface.high - step); // its upper layer's lower end
    input("cut").value = String(surface.cut);
  }

  private tell(): void {
    for (const id of ["cut", "slice"]) {
      const text = `${metres(this.page.base.z + input(id).valueAsNumber, 2)} m`;
      element(`${id}-text`).textContent = text;
      input(id).setAttribute("aria-valuetext", text);
    }
  }
}
