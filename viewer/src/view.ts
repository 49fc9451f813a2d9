// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { corners_of, distance_to_see_all, step_aside } from "./framing";

/** Half of the height that is seen from above at least, metres: nearer there is nothing to see. */
const kNearest = 0.1;

/** From where the picture is looked at: in perspective from the side, or straight down. Positions are metres from the map's lowest corner, z up. */
export abstract class View {
  readonly controls: OrbitControls;
  /** Space that is worth looking at. */
  readonly box = new THREE.Box3(new THREE.Vector3(), new THREE.Vector3(1, 1, 1));
  /** Pixels at the canvas's left that something lies over. */
  covered: () => number = () => 0;

  private readonly perspective = new THREE.PerspectiveCamera(50, 1, 0.05, 1000);
  private readonly orthographic = new THREE.OrthographicCamera(-1, 1, 1, -1, -1000, 1000);
  private camera_now: THREE.PerspectiveCamera | THREE.OrthographicCamera = this.perspective;
  /** The view that was last asked for, until the user turns it. */
  private preset?: () => void;
  private flight = 0;

  constructor(protected readonly canvas: HTMLCanvasElement) {
    for (const camera of [this.perspective, this.orthographic]) camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.perspective, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.screenSpacePanning = false;
    let is_held = false; // a click alone turns nothing
    this.controls.addEventListener("start", () => {
      is_held = true;
      cancelAnimationFrame(this.flight);
    });
    this.controls.addEventListener("change", () => {
      if (is_held) this.preset = undefined;
    });
    this.controls.addEventListener("end", () => (is_held = false));
  }

  /** Asks for a frame in which anything may be another. */
  abstract changed(): void;

  get camera(): THREE.Camera {
    return this.camera_now;
  }
  get is_orthographic(): boolean {
    return this.camera_now === this.orthographic;
  }

  /** How many pixels of the page a length takes, metres, where the view turns around. */
  css_pixels_of(length: number): number {
    const height = this.canvas.clientHeight;
    if (this.is_orthographic) return (length * height * this.orthographic.zoom) / (2 * this.orthographic.top);
    const distance = this.perspective.position.distanceTo(this.controls.target);
    return (length * height) / (2 * distance * Math.tan(THREE.MathUtils.degToRad(this.perspective.fov / 2)));
  }

  /** Fits the view to a canvas of another size. */
  protected fit_view(): void {
    this.perspective.aspect = this.aspect;
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
    this.controls.maxDistance = 4 * reach; // farther off nothing would be drawn
    this.controls.minZoom = 0.2;
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
    this.controls.maxZoom = Math.max(1, this.orthographic.top / kNearest);
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

  /** Moves the view to a place, so that so many metres around it can be seen; from steeply above where something hides it from the side. */
  fly_to(place: THREE.Vector3, around: number, hides: (ray: THREE.Ray, distance: number) => boolean): void {
    cancelAnimationFrame(this.flight);
    if (this.is_orthographic) this.look_from_side();
    this.preset = undefined;
    const target = this.controls.target.clone();
    const from = this.perspective.position.clone();
    const back = from.clone().sub(target).normalize();
    back.z = Math.max(back.z, 0.8);
    const distance = 2.2 * around;
    if (hides(new THREE.Ray(place, back.normalize()), distance)) back.set(0.02 * back.x, 0.02 * back.y, 1).normalize();
    const to = place.clone().add(back.multiplyScalar(distance));
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
    cancelAnimationFrame(this.flight);
    this.preset = undefined;
    if (this.camera_now === this.orthographic) {
      this.orthographic.zoom = Math.min(this.controls.maxZoom, Math.max(this.controls.minZoom, this.orthographic.zoom / farther));
      this.orthographic.updateProjectionMatrix();
      const step = this.orthographic.top / this.orthographic.zoom;
      const move = new THREE.Vector3(right * step, up * step, 0);
      this.controls.target.add(move);
      this.orthographic.position.add(move);
    } else {
      const offset = new THREE.Spherical().setFromVector3(swapped(this.perspective.position.clone().sub(this.controls.target)));
      offset.theta += right;
      offset.phi = Math.min(Math.PI - 0.05, Math.max(0.05, offset.phi - up));
      offset.radius = Math.min(this.controls.maxDistance, Math.max(2 * this.perspective.near, offset.radius * farther));
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

// three.js takes y for up in spherical coordinates.
function swapped(v: THREE.Vector3): THREE.Vector3 {
  return new THREE.Vector3(v.y, v.z, v.x);
}
function unswapped(v: THREE.Vector3): THREE.Vector3 {
  return new THREE.Vector3(v.z, v.x, v.y);
}
