// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";
import { kDark } from "./colours";
import { StillPicture } from "./still_picture";
import { View } from "./view";

/** Turns are slow in software: then less is drawn of each frame while the view moves. */
const kSlowFrame = 50; // milliseconds
const kStill = 250;
/** How long a frame waits for an answer that changes it, too. */
const kAnswer = 50;

/**
 * The picture: lights, and a frame when something has changed, none otherwise. What stands is drawn
 * once and kept for as long as the view stands, so that what moves over it costs a frame no more than itself.
 */
export class Stage extends View {
  /** What stands. */
  readonly scene = new THREE.Scene();
  /** What moves over it, and is hidden by it: routes and drones. */
  readonly overlay = new THREE.Scene();
  readonly renderer: THREE.WebGLRenderer;
  /** Called before a frame, which is coarse while the view moves and frames are slow: whether less than all is drawn. */
  readonly before_frame: ((is_coarse: boolean) => boolean | void)[] = [];
  /** Called once a frame has been drawn, for what has to be seen with it. */
  readonly after_frame: (() => void)[] = [];
  /** Nothing is drawn but when draw() is called: not all that belongs to the first picture is there. */
  holds = false;
  frames = 0;
  /** Frames for which all that stands was drawn. */
  stills = 0;

  private readonly still = new StillPicture();
  private is_still_old = true;
  private asked = 0; // the next frame
  private awaiting = 0;
  private coarse = false;
  private is_moving_over = false;
  private frame_time = 0;
  private still_timer = 0;

  constructor(canvas: HTMLCanvasElement) {
    super(canvas);
    this.renderer = renderer_of(canvas);
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace; // colours are drawn as given
    this.renderer.autoClear = false;
    for (const scene of [this.scene, this.overlay]) {
      const sun = new THREE.DirectionalLight(0xffffff, 1.5);
      sun.position.set(1, -2, 3);
      scene.add(new THREE.HemisphereLight(0xffffff, 0x777777, 2.5), sun);
    }
    this.controls.addEventListener("change", () => this.moves());
    new ResizeObserver(() => {
      this.look_again();
      this.changed();
    }).observe(canvas);
    const dark = matchMedia(kDark);
    const paint = () => {
      const ground = getComputedStyle(document.documentElement).getPropertyValue("--ground").trim();
      this.renderer.setClearColor(new THREE.Color().setStyle(ground, THREE.LinearSRGBColorSpace));
      this.changed();
    };
    dark.addEventListener("change", paint);
    // After what three.js does then itself: the graphics card has lost the picture, and the colour of the ground.
    canvas.addEventListener("webglcontextrestored", paint);
    paint();
  }

  /** Whether frames are slow when all that stands is drawn. */
  get is_slow(): boolean {
    return this.frame_time > kSlowFrame;
  }

  /** How many pixels of the canvas as it is drawn a length takes, metres, where the view turns around. */
  pixels_of(length: number): number {
    return this.css_pixels_of(length) * this.renderer.getPixelRatio();
  }

  /** Something moves: where frames are slow, coarse ones are drawn until it is still. */
  moves(): void {
    this.coarse = this.is_slow;
    this.changed();
    clearTimeout(this.still_timer);
    if (!this.coarse) return;
    this.still_timer = window.setTimeout(() => {
      this.coarse = false;
      this.changed();
    }, kStill);
  }

  /** Something begins or ends to move over the map: where frames are slow, with fewer pixels meanwhile. */
  moves_over(is_moving: boolean): void {
    this.is_moving_over = is_moving;
    this.changed_over();
  }

  /** Asks for a frame in which anything may be another. */
  changed(): void {
    this.is_still_old = true;
    this.changed_over();
  }

  /** Asks for a frame in which only what moves over the map is another. */
  changed_over(): void {
    if (this.asked) return;
    this.asked = requestAnimationFrame(() => {
      this.asked = 0;
      if (!this.holds) this.draw();
    });
  }

  /** As changed_over, of what an answer that is on its way changes, too: that calls answered(). */
  changes_with_answer(): void {
    if (!this.awaiting) this.awaiting = window.setTimeout(() => this.changed_over(), kAnswer);
  }

  /** The frame after a drag's step is drawn as soon as all of it is known: it can be seen in the next frame of the page, not the one after. */
  answered(): void {
    if (this.awaiting) this.draw();
  }

  draw(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    cancelAnimationFrame(this.asked);
    clearTimeout(this.awaiting);
    this.asked = this.awaiting = 0;
    const started = performance.now();
    this.fit_canvas(width, height);
    let is_less = false;
    if (this.is_still_old) {
      for (const act of this.before_frame) if (act(this.coarse)) is_less = true;
      this.still.take(this.renderer, this.scene, this.camera);
      ++this.stills;
    }
    this.still.put(this.renderer);
    this.renderer.render(this.overlay, this.camera);
    if (this.is_still_old && !this.coarse && !this.is_moving_over) {
      const time = this.wait_for_picture() - started;
      // How long all takes is not less than a part of it does.
      this.frame_time = is_less ? Math.max(this.frame_time, time) : time;
    }
    this.is_still_old = false;
    ++this.frames;
    for (const act of this.after_frame) act();
  }

  /** Drawing ends after its commands: a pixel that is read back waits for it. Not while things move. */
  wait_for_picture(): number {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    return performance.now();
  }

  /** Setting a size empties the canvas, so it is set only where it is another. What stands is drawn anew for more pixels only. */
  private fit_canvas(width: number, height: number): void {
    const has_few_pixels = this.coarse || (this.is_moving_over && this.is_slow);
    const ratio = has_few_pixels ? 0.5 : Math.min(devicePixelRatio, 2);
    const now = this.renderer.getSize(new THREE.Vector2());
    const is_as_large = now.x === width && now.y === height;
    if (this.renderer.getPixelRatio() === ratio && is_as_large) return;
    if (!is_as_large || Math.floor(ratio * width) > this.still.width) this.is_still_old = true;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.fit_view();
  }

}

function renderer_of(canvas: HTMLCanvasElement): THREE.WebGLRenderer {
  try {
    // Opaque: what puts the page together has nothing to mix, which in software is a quarter of its work.
    const options: WebGLContextAttributes = { alpha: false, antialias: false, powerPreference: "high-performance" };
    return new THREE.WebGLRenderer({ canvas, context: canvas.getContext("webgl2", options) as WebGL2RenderingContext });
  } catch {
    throw new Error("this browser has no WebGL 2. Turn on graphics acceleration in its settings, or take another one");
  }
}
