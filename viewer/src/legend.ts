// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import { css_ramp, type Ramp, type Rgb } from "./colours";
import { swatch } from "./drawings";

/** What colours mean, of the layers that are shown. */
export class Legend {
  private readonly rows: HTMLElement[] = [];
  /** `box`: which is folded, at first where there is little room, and holds the rows. */
  constructor(private readonly box: HTMLDetailsElement, private readonly root: HTMLElement) {
    box.open = !matchMedia("(max-width: 760px), (max-height: 500px)").matches;
  }

  begin(): void {
    this.rows.length = 0;
  }
  ramp(title: string, ramp: Ramp, low: string, high: string): void {
    const row = document.createElement("div");
    row.textContent = title;
    const bar = document.createElement("div");
    bar.className = "bar";
    bar.style.background = css_ramp(ramp);
    const ends = document.createElement("div");
    ends.className = "ends";
    for (const text of [low, high]) {
      const end = document.createElement("span");
      end.textContent = text;
      ends.append(end);
    }
    row.append(bar, ends);
    this.rows.push(row);
  }
  mark(text: string, rgb: Rgb): void {
    const row = document.createElement("div");
    row.append(swatch(rgb), text);
    this.rows.push(row);
  }
  end(): void {
    this.root.replaceChildren(...this.rows);
    this.box.hidden = this.rows.length === 0;
  }
}
