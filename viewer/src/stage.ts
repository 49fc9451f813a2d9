// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { corners_of, distance_to_see_all, step_aside } from "./framing";
import { StillPicture } from "./still_picture";

/** Turns are slow in software: then less is drawn of each frame while the view moves. */
const kSlowFrame = 50; // milliseconds
const kStill = 250;
/** How long a frame waits for an answer that changes it, too. */
const kAnswer = 50;

/**
 * The picture: camera, lights and a frame when something has changed, none otherwise. Positions are
 * metres from the map's lowest corner, z up. What stands is drawn once and kept for as long as the
 * view stands, so that what moves over it costs a frame no more than itself.
 */
export class Stage {
  /** What stands. */
  readonly scene = new THREE.Scene();
  /** What moves over it, and is hidden by it: routes and drones. */
  readonly overlay = new THREE.Scene();
  readonly renderer: THREE.WebGLRenderer;
  readonly controls: OrbitControls;
  /** Space that is worth looking at. */
  readonly box = new THREE.Box3(new THREE.Vector3(), new THREE.Vector3(1, 1, 1));
  /** Called before a frame, which is coarse while the view moves and frames are slow: whether less than all is drawn. */
  readonly before_frame: ((is_coarse: boolean) => boolean | void)[] = [];
  /** Called once a frame has been drawn, for what has to be seen with it. */
  readonly after_frame: (() => void)[] = [];
  /** Pixels at the canvas's left that something lies over. */
  covered: () => number = () => 0;
  /** Nothing is drawn but when draw() is called: not all that belongs to the first picture is there. */
  holds = false;
  frames = 0;
  /** Frames for which all that stands was drawn. */
  stills = 0;

  private readonly perspective = new THREE.PerspectiveCamera(50, 1, 0.05, 1000);
  private readonly orthographic = new THREE.OrthographicCamera(-1, 1, 1, -1, -1000, 1000);
  private camera_now: THREE.PerspectiveCamera | THREE.OrthographicCamera = this.perspective;
  private readonly still = new StillPicture();
  private is_still_old = true;
  private asked = 0; // the next frame
  private awaiting = 0;
  private coarse = false;
  private is_moving_over = false;
  /** The view that was last asked for, until the user turns it. */
  private preset?: () => void;
  private frame_time = 0;
  private still_timer = 0;
  private flight = 0;

  constructor(private readonly canvas: HTMLCanvasElement) {
    this.renderer = renderer_of(canvas);
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace; // colours are drawn as given
    this.renderer.autoClear = false;
    for (const scene of [this.scene, this.overlay]) {
      const sun = new THREE.DirectionalLight(0xffffff, 1.5);
      sun.position.set(1, -2, 3);
      scene.add(new THREE.HemisphereLight(0xffffff, 0x777777, 2.5), sun);
    }
    for (const camera of [this.perspective, this.orthographic]) camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.perspective, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.screenSpacePanning = false;
    this.controls.addEventListener("change", () => this.moves());
    this.controls.addEventListener("start", () => (this.preset = undefined));
    new ResizeObserver(() => {
      this.look_again();
      this.changed();
    }).observe(canvas);
    const dark = matchMedia("(prefers-color-scheme: dark)");
    const paint = () => {
      const ground = getComputedStyle(document.documentElement).getPropertyValue("--ground").trim();
      this.renderer.setClearColor(new THREE.Color().setStyle(ground, THREE.LinearSRGBColorSpace));
      this.changed();
    };
    dark.addEventListener("change", paint);
    paint();
  }

  /** Whether frames are slow when all that stands is drawn. */
  get is_slow(): boolean {
    return this.frame_time > kSlowFrame;
  }

  /** How many pixels of the canvas a length takes, metres, where the view turns around. */
  pixels_of(length: number): number {
    const height = this.renderer.domElement.height;
    if (this.is_orthographic) return (length * height * this.orthographic.zoom) / (2 * this.orthographic.top);
    const distance = this.perspective.position.distanceTo(this.controls.target);
    return (length * height) / (2 * distance * Math.tan(THREE.MathUtils.degToRad(this.perspective.fov / 2)));
  }

  get camera(): THREE.Camera {
    return this.camera_now;
  }
  get is_orthographic(): boolean {
    return this.camera_now === this.orthographic;
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
      this.still.take(this.renderer, this.scene, this.camera_now);
      ++this.stills;
    }
    this.still.put(this.renderer);
    this.renderer.render(this.overlay, this.camera_now);
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
    this.perspective.aspect = width / height;
    this.perspective.updateProjectionMatrix();
    this.fit_orthographic();
  }

  private fit_orthographic(): void {
    const half = this.orthographic.top * this.aspect;
    this.orthographic.left = -half;
    this.orthographic.right = half;
    this.orthographic.updateProjectionMatrix();
  }

  /** Space that is worth looking at. */
  set_box(low: THREE.Vector3, high: THREE.Vector3): void {
    this.box.set(low, high);
    const reach = this.size.length();
    this.perspective.far = 6 * reach;
    this.perspective.near = Math.max(0.02, reach / 5000);
    this.orthographic.near = -3 * reach;
    this.orthographic.far = 3 * reach;
    this.perspective.updateProjectionMatrix();
    this.fit_orthographic();
  }
  private get aspect(): number {
    return this.canvas.clientWidth / Math.max(1, this.canvas.clientHeight);
  }
  get size(): THREE.Vector3 {
    return this.box.getSize(new THREE.Vector3());
  }

  /** Follows the box with the view, unless the user has turned it. */
  look_again(): void {
    this.preset?.();
  }

  private use(camera: THREE.PerspectiveCamera | THREE.OrthographicCamera): void {
    this.camera_now = camera;
    this.controls.object = camera;
    this.controls.enableRotate = camera === this.perspective;
    this.controls.mouseButtons.LEFT = camera === this.perspective ? THREE.MOUSE.ROTATE : THREE.MOUSE.PAN;
  }

  look_from_side(): void {
    cancelAnimationFrame(this.flight);
    this.use(this.perspective);
    this.preset = () => this.look_from_side();
    const middle = this.box.getCenter(new THREE.Vector3());
    const back = new THREE.Vector3(-0.25, -0.75, 0.85).normalize();
    const from = back.clone().multiplyScalar(distance_to_see_all(this.perspective, this.aspect, this.box, middle, back));
    this.controls.target.copy(middle);
    this.perspective.position.copy(middle).add(from);
    this.controls.update();
    this.move_aside();
    this.changed();
  }

  look_from_above(): void {
    cancelAnimationFrame(this.flight);
    this.use(this.orthographic);
    this.preset = () => this.look_from_above();
    const { size } = this;
    const middle = this.box.getCenter(new THREE.Vector3());
    this.orthographic.top = 0.54 * Math.max(size.y, size.x / this.aspect);
    this.orthographic.bottom = -this.orthographic.top;
    this.orthographic.zoom = 1;
    this.orthographic.position.set(middle.x, middle.y - 1e-3, middle.z + size.length());
    this.fit_orthographic();
    this.controls.target.copy(middle);
    this.controls.update();
    this.move_aside();
    this.changed();
  }

  /** Moves the box to the right, as far as there is room, from below what lies over the canvas. */
  private move_aside(): void {
    const across = corners_of(this.box).map((corner) => this.on_canvas(corner)?.x ?? 0);
    const step = step_aside(Math.min(...across), Math.max(...across), this.covered(), this.canvas.clientWidth);
    if (step === 0) return;
    const at = this.on_canvas(this.controls.target)!;
    const target = this.ray_at(at.x - step, at.y).intersectPlane(
      new THREE.Plane().setFromNormalAndCoplanarPoint(this.camera_now.getWorldDirection(new THREE.Vector3()), this.controls.target), new THREE.Vector3());
    if (!target) return;
    this.camera_now.position.add(target.clone().sub(this.controls.target));
    this.controls.target.copy(target);
    this.controls.update();
  }

  /** Moves the view to a place, so that so many metres around it can be seen. */
  fly_to(place: THREE.Vector3, around: number): void {
    cancelAnimationFrame(this.flight);
    if (this.is_orthographic) this.look_from_side();
    this.preset = undefined;
    const target = this.controls.target.clone();
    const from = this.perspective.position.clone();
    const back = from.clone().sub(target).normalize();
    back.z = Math.max(back.z, 0.8);
    const to = place.clone().add(back.normalize().multiplyScalar(2.2 * around));
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const started = performance.now();
    const step = () => {
      const x = still ? 1 : Math.min(1, (performance.now() - started) / 600);
      const share = x * x * (3 - 2 * x);
      this.controls.target.lerpVectors(target, place, share);
      this.perspective.position.lerpVectors(from, to, share);
      this.controls.update();
      this.changed();
      if (x < 1) this.flight = requestAnimationFrame(step);
    };
    step();
  }

  /** Turns the view, radians, and moves it nearer (below 1) or farther. */
  turn(right: number, up: number, farther: number): void {
    this.preset = undefined;
    if (this.camera_now === this.orthographic) {
      this.orthographic.zoom /= farther;
      const step = this.orthographic.top / this.orthographic.zoom;
      const move = new THREE.Vector3(right * step, up * step, 0);
      this.controls.target.add(move);
      this.orthographic.position.add(move);
    } else {
      const offset = new THREE.Spherical().setFromVector3(swapped(this.perspective.position.clone().sub(this.controls.target)));
      offset.theta += right;
      offset.phi = Math.min(Math.PI - 0.05, Math.max(0.05, offset.phi - up));
      offset.radius *= farther;
      this.perspective.position.copy(this.controls.target).add(unswapped(new THREE.Vector3().setFromSpherical(offset)));
    }
    this.controls.update();
    this.changed();
  }

  ray_at(x: number, y: number): THREE.Ray {
    const caster = new THREE.Raycaster();
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.camera_now.updateMatrixWorld();
    caster.setFromCamera(new THREE.Vector2((2 * x) / width - 1, 1 - (2 * y) / height), this.camera_now as THREE.PerspectiveCamera);
    return caster.ray;
  }

  /** Where a place is on the canvas, CSS pixels; nothing behind the camera. */
  on_canvas(place: THREE.Vector3): { x: number; y: number } | undefined {
    this.camera_now.updateMatrixWorld();
    const p = place.clone().project(this.camera_now);
    if (p.z < -1 || p.z > 1) return undefined;
    return { x: ((p.x + 1) / 2) * this.canvas.clientWidth, y: ((1 - p.y) / 2) * this.canvas.clientHeight };
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

// three.js takes y for up in spherical coordinates.
function swapped(v: THREE.Vector3): THREE.Vector3 {
  return new THREE.Vector3(v.y, v.z, v.x);
}
function unswapped(v: THREE.Vector3): THREE.Vector3 {
  return new THREE.Vector3(v.z, v.x, v.y);
}
