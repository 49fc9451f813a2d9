// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";
import { kHeights } from "./colours";
import type { Surface } from "./layers";

// Rectangles meet at places that are corners of one and not of the other, where rounding would leave
// pixels between them: each is drawn a part of a pixel larger, in its own plane.
const kVertex = `
uniform vec3 origin;
uniform float cell_size, cut, pixel;
uniform mat4 seen;
in vec4 corner;
out vec3 place;
flat out vec3 normal_out;
void main() {
  int code = int(corner.w + 0.5);
  int side = code & 7;
  int axis = side >> 1;
  float away = float(2 * (side & 1) - 1);
  float right = float((code >> 2 & 2) - 1), up = float((code >> 3 & 2) - 1);
  normal_out = axis == 0 ? vec3(away, 0.0, 0.0) : axis == 1 ? vec3(0.0, away, 0.0) : vec3(0.0, 0.0, away);
  place = origin + cell_size * corner.xyz;
  bool above = axis == 2 && place.z > cut + 1e-4;
  place.z = min(place.z, cut);
  vec4 at = seen * vec4(place, 1.0);
  vec3 larger = axis == 0 ? vec3(0.0, right, up) : axis == 1 ? vec3(right, 0.0, up) : vec3(right, up, 0.0);
  at += seen * vec4(pixel * at.w * larger, 0.0);
  gl_Position = above ? vec4(0.0, 0.0, 2.0, 1.0) : at;
}`;

// Faces seen from behind are the insides of walls that were cut, or of rooms seen from outside.
const kFragment = `
uniform vec3 ramp[5];
uniform float low, high;
uniform vec3 towards;
uniform bool is_parallel;
in vec3 place;
flat in vec3 normal_out;
out vec4 colour;
void main() {
  float x = clamp((place.z - low) / (high - low), 0.0, 1.0) * 4.0;
  int i = min(int(x), 3);
  vec3 base = mix(ramp[i], ramp[i + 1], x - float(i));
  vec3 view = is_parallel ? towards : cameraPosition - place;
  float facing = dot(normal_out, view);
  float light = normal_out.z > 0.5 ? 1.0 : normal_out.z < -0.5 ? 0.6 : abs(normal_out.x) > 0.5 ? 0.85 : 0.72;
  colour = vec4(facing > 0.0 ? base * light : base * 0.34, 1.0);
}`;

/** Pixels that a rectangle is drawn larger by, to each side: some of the 256 parts of a pixel that corners are rounded to. */
const kLarger = 0.02;

/** Of the ground plan, that what is taken for ceilings covers at least: of indoor maps it covers 0.2 and more, of a campus and of rocks in space 0.07 and less. */
const kLeastCeilings = 0.1;

export interface Hit {
  distance: number;
  place: THREE.Vector3;
  normal: THREE.Vector3;
  /** Inside an obstacle, where it is cut. */
  is_cut?: boolean;
}

/** A surface as it is drawn. */
class Drawable {
  readonly geometry = new THREE.BufferGeometry();
  readonly origin: THREE.Vector3;
  /** How many rectangles begin below a height of cells; those are the first. */
  private readonly below: Uint32Array;

  constructor(readonly surface: Surface, base: THREE.Vector3) {
    this.origin = new THREE.Vector3(...surface.origin).sub(base);
    const { cells, count } = surface;
    let highest = 0;
    for (let i = 0; i < count; ++i) highest = Math.max(highest, cells[4 * i + 2]!);
    this.below = new Uint32Array(highest + 2);
    for (let i = 0; i < count; ++i) ++this.below[cells[4 * i + 2]! + 1]!;
    for (let z = 1; z < this.below.length; ++z) this.below[z]! += this.below[z - 1]!;
    const next = this.below.slice();
    const order = new Uint32Array(count);
    for (let i = 0; i < count; ++i) order[next[cells[4 * i + 2]!]!++] = i;
    const { corners, index } = expanded(surface, order);
    this.geometry.setAttribute("corner", new THREE.BufferAttribute(corners, 4, false));
    this.geometry.setIndex(new THREE.BufferAttribute(index, 1));
  }

  cut_at(height: number): void {
    const z = Math.ceil((height - this.origin.z) / this.surface.cell) + 1;
    this.geometry.setDrawRange(0, 6 * this.below[Math.min(this.below.length - 1, Math.max(0, z))]!);
  }
}

/** Four corners a rectangle: x, y, z in cells, and the side, plus 8 and 16 at the far ends of its width and height. (Software draws instances one by one.) */
function expanded({ cells, sizes, count }: Surface, order: Uint32Array): { corners: Uint16Array | Float32Array; index: Uint32Array } {
  // Attributes of 32 bits would be whole numbers in the shader; floats hold all voxels of a live map.
  const corners = cells instanceof Uint16Array ? new Uint16Array(16 * count) : new Float32Array(16 * count);
  const index = new Uint32Array(6 * count);
  for (let place = 0; place < count; ++place) {
    const i = order[place]!;
    const side = cells[4 * i + 3]!;
    const axis = side >> 1;
    const u = axis === 0 ? 1 : 0;
    const v = axis === 2 ? 1 : 2;
    for (let k = 0; k < 4; ++k) {
      const at = 16 * place + 4 * k;
      corners[at] = cells[4 * i]!;
      corners[at + 1] = cells[4 * i + 1]!;
      corners[at + 2] = cells[4 * i + 2]!;
      corners[at + 3] = side | (k === 1 || k === 2 ? 8 : 0) | (k >= 2 ? 16 : 0);
      corners[at + axis]! += side & 1;
      if (k === 1 || k === 2) corners[at + u]! += sizes[4 * i]!;
      if (k >= 2) corners[at + v]! += sizes[4 * i + 1]!;
    }
    const c = 4 * place;
    const to = 6 * place;
    index[to] = index[to + 3] = c;
    index[to + 1] = c + 1;
    index[to + 2] = index[to + 4] = c + 2;
    index[to + 5] = c + 3;
  }
  return { corners, index };
}

/**
 * Obstacles as rectangles, cut off above a height: a coarse surface, which is there first and, where
 * frames are slow, is drawn while the view moves or is far; and the fine one.
 */
export class SurfaceMesh {
  readonly mesh: THREE.Mesh<THREE.BufferGeometry, THREE.ShaderMaterial>;
  low = 0;
  high: number;
  private readonly material: THREE.ShaderMaterial;
  private readonly drawing_size = new THREE.Vector2();
  private coarse: Drawable;
  private fine: Drawable;

  /** `base`: the world's place of (0, 0, 0). */
  constructor(coarse: Surface, private readonly base: THREE.Vector3, height: number) {
    this.coarse = this.fine = new Drawable(coarse, base);
    this.high = height;
    this.material = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: kVertex,
      fragmentShader: kFragment,
      side: THREE.DoubleSide,
      uniforms: {
        origin: { value: this.coarse.origin },
        cell_size: { value: coarse.cell },
        cut: { value: height },
        pixel: { value: 0 },
        seen: { value: new THREE.Matrix4() },
        ramp: { value: kHeights.map((c) => new THREE.Vector3(...c)) },
        low: { value: this.low },
        high: { value: Math.max(this.high, 1e-3) },
        towards: { value: new THREE.Vector3(0, 0, 1) },
        is_parallel: { value: false },
      },
    });
    this.mesh = new THREE.Mesh(this.coarse.geometry, this.material);
    this.mesh.frustumCulled = false;
    this.mesh.onBeforeRender = (renderer, _scene, camera) => {
      const drawn = this.mesh.geometry === this.fine.geometry ? this.fine : this.coarse;
      this.material.uniforms.origin!.value = drawn.origin;
      this.material.uniforms.cell_size!.value = drawn.surface.cell;
      this.material.uniforms.seen!.value.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).multiply(this.mesh.matrixWorld);
      this.material.uniforms.pixel!.value = kLarger * 2 / (camera.projectionMatrix.elements[5]! * renderer.getDrawingBufferSize(this.drawing_size).y);
      this.material.uniforms.is_parallel!.value = camera instanceof THREE.OrthographicCamera;
      this.material.uniforms.towards!.value.set(0, 0, 1).transformDirection(camera.matrixWorld);
      this.material.uniformsNeedUpdate = true;
    };
  }

  /** Side of the coarse surface's cells, metres. */
  get coarse_cell(): number {
    return this.coarse.surface.cell;
  }

  get cut(): number {
    return this.material.uniforms.cut!.value;
  }
  set cut(height: number) {
    this.material.uniforms.cut!.value = height;
    for (const drawable of [this.coarse, this.fine]) drawable.cut_at(height);
  }

  /** Until the next cut no more than one rectangle. */
  draw_little(): void {
    this.mesh.geometry.setDrawRange(0, 6);
  }

  refine(fine: Surface): void {
    this.fine = new Drawable(fine, this.base);
    this.cut = this.cut;
    this.draw_coarse(false);
  }

  /** Takes another surface, of a map that reaches from one height to another. */
  replace(surface: Surface, low: number, high: number): void {
    this.coarse.geometry.dispose();
    this.fine.geometry.dispose();
    this.coarse = this.fine = new Drawable(surface, this.base);
    this.low = low;
    this.high = high;
    this.material.uniforms.low!.value = low;
    this.material.uniforms.high!.value = Math.max(high, low + 1e-3);
    this.cut = this.cut;
    this.draw_coarse(false);
  }

  /** Returns whether that is less than there is. */
  draw_coarse(is_coarse: boolean): boolean {
    this.mesh.geometry = (is_coarse ? this.coarse : this.fine).geometry;
    return is_coarse && this.coarse !== this.fine;
  }

  /** Just below most ceilings, so that rooms can be looked into: half the faces that look down are higher. The top where hardly any of the map's ground plan (square metres) has a ceiling, or nothing would be left. */
  height_below_ceilings(plan: number): number {
    const { surface, origin } = this.coarse;
    const { cells, sizes, count, cell } = surface;
    const areas = new Map<number, number>();
    let total = 0;
    let lowest = Infinity;
    for (let i = 0; i < count; ++i) {
      lowest = Math.min(lowest, cells[4 * i + 2]!);
      if (cells[4 * i + 3] !== 4) continue;
      const area = sizes[4 * i]! * sizes[4 * i + 1]!;
      areas.set(cells[4 * i + 2]!, (areas.get(cells[4 * i + 2]!) ?? 0) + area);
      total += area;
    }
    let above = 0;
    for (const z of [...areas.keys()].sort((a, b) => b - a)) {
      above += areas.get(z)!;
      if (above < 0.5 * total) continue;
      if (above * cell ** 2 < kLeastCeilings * plan || z <= lowest) break;
      return Math.max(this.low + 0.3 * (this.high - this.low), origin.z + (z - 1) * cell);
    }
    return this.high;
  }

  /** The nearest face that a ray meets from its front, below the cut or anywhere. */
  hit(ray: THREE.Ray, anywhere = false): Hit | undefined {
    const { surface, origin } = this.fine;
    const { cells, sizes, count, cell } = surface;
    const from = ray.origin.clone().sub(origin).divideScalar(cell).toArray();
    const way = ray.direction.clone().divideScalar(cell).toArray();
    const cut = anywhere ? Infinity : (this.cut - origin.z) / cell;
    let nearest = Infinity;
    let found = -1;
    for (let i = 0; i < count; ++i) {
      const side = cells[4 * i + 3]!;
      const axis = side >> 1;
      const upper = side & 1;
      const speed = way[axis]!;
      if (upper ? speed >= 0 : speed <= 0) continue; // from behind
      const distance = (cells[4 * i + axis]! + upper - from[axis]!) / speed;
      if (!(distance > 0 && distance < nearest)) continue;
      const u = axis === 0 ? 1 : 0;
      const v = axis === 2 ? 1 : 2;
      const along = from[u]! + distance * way[u]! - cells[4 * i + u]!;
      if (along < 0 || along > sizes[4 * i]!) continue;
      const across = from[v]! + distance * way[v]! - cells[4 * i + v]!;
      if (across < 0 || across > sizes[4 * i + 1]!) continue;
      if (from[2]! + distance * way[2]! > cut + 1e-6) continue;
      nearest = distance;
      found = i;
    }
    if (found < 0) return undefined;
    const side = cells[4 * found + 3]!;
    const normal = new THREE.Vector3();
    normal.setComponent(side >> 1, side & 1 ? 1 : -1);
    return { distance: nearest, place: ray.at(nearest, new THREE.Vector3()), normal };
  }
}
