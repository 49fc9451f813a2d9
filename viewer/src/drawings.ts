// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";
import type { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { colour_at, component_colour, css_of, kClearances, type Rgb } from "./colours";
import { set_thin_lines, set_wide_lines, thin_lines, wide_lines } from "./lines";
import { kNotKnown, type Cloud, type Net, type Slice } from "./layers";

export type ColourBy = "clearance" | "component";

/** Of clearances between the robot's and the widest that is worth a colour of its own. */
export class ClearanceScale {
  constructor(readonly least: number, readonly most: number) {}
  colour(clearance: number): Rgb {
    return colour_at(kClearances, (clearance - this.least) / (this.most - this.least));
  }
}

export function three_colour(rgb: Rgb): THREE.Color {
  return new THREE.Color().setRGB(...rgb, THREE.LinearSRGBColorSpace);
}

/** Lets go of what the graphics card holds of a drawing; it is made again where it is drawn again. */
export function dispose(drawing: THREE.Object3D): void {
  drawing.traverse((part) => {
    if (!(part instanceof THREE.Mesh || part instanceof THREE.Line || part instanceof THREE.Points)) return;
    part.geometry.dispose();
    part.material.dispose();
  });
}

/** A diagram or a graph: lines between places, and places as points. */
export class NetDrawing {
  readonly group = new THREE.Group();
  private readonly lines: LineSegments2 | THREE.LineSegments;
  private readonly points?: THREE.Points;
  private net?: Net;
  private by: ColourBy = "clearance";

  constructor(private readonly base: THREE.Vector3, private readonly scale: ClearanceScale, width: number, point_size: number) {
    this.lines = width > 1 ? wide_lines(width) : thin_lines();
    this.group.add(this.lines);
    if (point_size === 0) return;
    this.points = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial({ size: point_size, sizeAttenuation: false, vertexColors: true }));
    this.points.frustumCulled = false;
    this.group.add(this.points);
  }

  show(net: Net): this {
    this.net = net;
    this.group.position.set(...net.origin).sub(this.base);
    this.points?.geometry.dispose();
    if (this.points) this.points.geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(net.positions, 3));
    this.colour_by(this.by);
    return this;
  }

  get knows_components(): boolean {
    return !!this.net?.component;
  }

  /** The components that its places lie in, where it is still of the map that they are of. */
  set components(numbers: Uint32Array) {
    if (this.net && numbers.length === this.net.clearance.length) this.net.component = numbers;
  }

  colour_by(what: ColourBy): void {
    this.by = what;
    const { net, scale } = this;
    if (!net) return;
    const place_colour = (v: number) => (what === "component" ? component_colour(net.component?.[v] ?? 0) : scale.colour(net.clearance[v]!));
    const at = new Float32Array(3 * net.pairs.length);
    const colours = new Float32Array(3 * net.pairs.length);
    for (let i = 0; i < net.pairs.length; ++i) {
      at.set(net.positions.subarray(3 * net.pairs[i]!, 3 * net.pairs[i]! + 3), 3 * i);
      const narrowest = net.pair_clearance?.[i >> 1];
      colours.set(what === "clearance" && narrowest !== undefined ? scale.colour(narrowest) : place_colour(net.pairs[i]!), 3 * i);
    }
    if (this.lines instanceof THREE.LineSegments) set_thin_lines(this.lines, at, colours);
    else set_wide_lines(this.lines, at, colours);
    if (!this.points) return;
    const points = new Float32Array(net.positions.length);
    for (let v = 0; v < net.clearance.length; ++v) points.set(place_colour(v), 3 * v);
    this.points.geometry.setAttribute("color", new THREE.BufferAttribute(points, 3));
  }
}

export function cloud_drawing(cloud: Cloud, base: THREE.Vector3, scale: ClearanceScale): THREE.Points {
  const colours = new Float32Array(cloud.positions.length);
  for (let i = 0; i < cloud.clearance.length; ++i) colours.set(scale.colour(cloud.clearance[i]!), 3 * i);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(cloud.positions, 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3));
  const points = new THREE.Points(geometry, new THREE.PointsMaterial({ size: 1.6, sizeAttenuation: false, vertexColors: true }));
  points.frustumCulled = false;
  points.position.set(...cloud.origin).sub(base);
  return points;
}

/** Distances at one height. Where the robot does not fit it is dark red. */
export class SliceDrawing {
  readonly mesh = new THREE.Mesh(
    new THREE.PlaneGeometry(1, 1).translate(0.5, 0.5, 0),
    new THREE.MeshBasicMaterial({ transparent: true, opacity: 0.88, side: THREE.DoubleSide, depthWrite: false }),
  );

  constructor() {
    this.mesh.visible = false;
  }

  /** Nothing is known of the height that is asked for. */
  clear(): void {
    this.mesh.scale.set(0, 0, 0);
  }

  show(slice: Slice, base: THREE.Vector3, scale: ClearanceScale): void {
    const { columns, rows, millimetres, step } = slice;
    const pixels = new Uint8Array(4 * Math.max(1, columns * rows));
    for (let i = 0; i < columns * rows; ++i) {
      const value = millimetres[i]!;
      if (value === kNotKnown) continue;
      const metres = value / 1000;
      const [r, g, b] = metres < scale.least ? ([0.35, 0.05, 0.08] as Rgb) : scale.colour(metres);
      pixels.set([255 * r, 255 * g, 255 * b, 255], 4 * i);
    }
    const texture = new THREE.DataTexture(pixels, Math.max(1, columns), Math.max(1, rows));
    texture.needsUpdate = true;
    const material = this.mesh.material;
    material.map?.dispose();
    const had_none = !material.map;
    material.map = texture;
    if (had_none) material.needsUpdate = true;
    this.mesh.position.set(...slice.origin).sub(base);
    this.mesh.scale.set(step * columns, step * rows, 1);
  }
}

/** A path as a band so many pixels wide, drawn over what hides it too, fainter. */
export class PathDrawing {
  readonly group = new THREE.Group();
  private readonly lines: LineSegments2[];

  constructor(private readonly colour: Rgb, width: number) {
    this.lines = [true, false].map((hidden) => {
      const lines = wide_lines(width);
      lines.material.transparent = hidden;
      lines.material.depthTest = !hidden;
      if (hidden) lines.material.opacity = 0.35;
      lines.renderOrder = hidden ? 2 : 3;
      return lines;
    });
    this.group.add(...this.lines);
  }

  /** Fewer than two places are no path: nothing is drawn. */
  show(path: THREE.Vector3[]): this {
    const at = new Float32Array(6 * Math.max(0, path.length - 1));
    const colours = new Float32Array(at.length);
    for (let i = 0; i + 1 < path.length; ++i) {
      path[i]!.toArray(at, 6 * i);
      path[i + 1]!.toArray(at, 6 * i + 3);
      colours.set([...this.colour, ...this.colour], 6 * i);
    }
    for (const lines of this.lines) set_wide_lines(lines, at, colours);
    return this;
  }
}

/** A ball that keeps the robot's size, and can be seen through walls, faintly. */
export function ball(colour: Rgb, radius: number): THREE.Group {
  const group = new THREE.Group();
  const geometry = new THREE.SphereGeometry(1, 24, 16);
  for (const hidden of [true, false]) {
    const mesh = new THREE.Mesh(
      geometry,
      new THREE.MeshLambertMaterial({ color: three_colour(colour), transparent: true, opacity: hidden ? 0.3 : 0.75, depthTest: !hidden, depthWrite: !hidden }),
    );
    mesh.renderOrder = hidden ? 4 : 5;
    group.add(mesh);
  }
  group.scale.setScalar(radius);
  return group;
}

/** A drone that just fits in a ball of radius 1: four rotors, and the ball itself. */
export function drone(colour: Rgb): THREE.Group {
  const group = new THREE.Group();
  const dark = new THREE.MeshLambertMaterial({ color: 0x30363d });
  const bright = new THREE.MeshLambertMaterial({ color: three_colour(colour) });
  for (const angle of [0.25, 0.75, 1.25, 1.75].map((x) => x * Math.PI)) {
    const [x, y] = [0.6 * Math.cos(angle), 0.6 * Math.sin(angle)];
    const arm = new THREE.Mesh(new THREE.BoxGeometry(0.62, 0.07, 0.06), dark);
    arm.position.set(x / 2, y / 2, 0);
    arm.rotation.z = angle;
    const rotor = new THREE.Mesh(new THREE.TorusGeometry(0.32, 0.045, 8, 24), Math.cos(angle) > 0 ? bright : dark);
    rotor.position.set(x, y, 0.06);
    group.add(arm, rotor);
  }
  const body = new THREE.Mesh(new THREE.BoxGeometry(0.34, 0.22, 0.16), bright);
  const hull = new THREE.Mesh(new THREE.SphereGeometry(1, 24, 16), new THREE.MeshBasicMaterial({ color: three_colour(colour), transparent: true, opacity: 0.18, depthWrite: false }));
  group.add(body, hull);
  return group;
}

/** Places as rings of their radius, and a text each; texts are of HTML, so they stay sharp. */
export class LabelLayer {
  private readonly spans: { span: HTMLSpanElement; place: THREE.Vector3 }[] = [];
  visible = true;

  constructor(private readonly root: HTMLElement) {}

  add(place: THREE.Vector3, text: string): void {
    const span = document.createElement("span");
    span.textContent = text;
    this.root.append(span);
    this.spans.push({ span, place });
  }
  clear(): void {
    for (const { span } of this.spans) span.remove();
    this.spans.length = 0;
  }
  place(on_canvas: (place: THREE.Vector3) => { x: number; y: number } | undefined): void {
    const placed: { x: number; y: number }[] = [];
    for (const { span, place } of this.spans) {
      const at = this.visible ? on_canvas(place) : undefined;
      // Where texts would cover each other, the first is read.
      const is_covered = !!at && placed.some((other) => Math.abs(other.x - at.x) < 58 && Math.abs(other.y - at.y) < 22);
      span.hidden = !at || is_covered;
      if (at && !is_covered) {
        placed.push(at);
        span.style.left = `${at.x}px`;
        span.style.top = `${at.y}px`;
      }
    }
  }
}

export function swatch(rgb: Rgb): HTMLElement {
  const mark = document.createElement("span");
  mark.className = "swatch";
  mark.style.background = css_of(rgb);
  return mark;
}
