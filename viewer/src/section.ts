// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";
import { section_colour } from "./colours";
import type { Section } from "./layers";

const kVertex = `
out vec2 at;
void main() {
  at = uv;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
const kFragment = `
uniform sampler2D cells;
uniform vec3 section;
in vec2 at;
out vec4 colour;
void main() {
  if (texture(cells, at).r < 0.5) discard;
  colour = vec4(section, 1.0);
}`;

/**
 * Where obstacles are cut, in one colour: their surface alone is faces towards free space, between
 * which one would look through them.
 */
export class SectionDrawing {
  readonly mesh: THREE.Mesh<THREE.PlaneGeometry, THREE.ShaderMaterial>;

  private shown?: Section;

  constructor() {
    const material = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: kVertex,
      fragmentShader: kFragment,
      side: THREE.DoubleSide,
      polygonOffset: true, // behind faces at the same height
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
      uniforms: { cells: { value: null }, section: { value: new THREE.Vector3(...section_colour()) } },
    });
    this.mesh = new THREE.Mesh(new THREE.PlaneGeometry(1, 1).translate(0.5, 0.5, 0), material);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
    this.mesh.onBeforeRender = () => {
      material.uniforms.section!.value.set(...section_colour());
      material.uniformsNeedUpdate = true;
    };
  }

  /** `base`: the world's place of (0, 0, 0) of the picture. */
  show({ columns, rows, step, bits, origin }: Section, base: THREE.Vector3): void {
    this.mesh.visible = columns * rows > 0;
    if (!this.mesh.visible) return;
    const cells = new Uint8Array(columns * rows);
    for (let i = 0; i < cells.length; ++i) cells[i] = (bits[i >> 3]! >> (i & 7)) & 1 ? 255 : 0;
    const texture = new THREE.DataTexture(cells, columns, rows, THREE.RedFormat);
    texture.unpackAlignment = 1;
    texture.needsUpdate = true;
    this.shown = { columns, rows, step, bits, origin };
    const { uniforms } = this.mesh.material;
    uniforms.cells!.value?.dispose();
    uniforms.cells!.value = texture;
    this.mesh.position.set(...origin).sub(base);
    this.mesh.scale.set(step * columns, step * rows, 1);
  }

  /** Whether an obstacle is cut at a place of the picture. */
  covers(x: number, y: number): boolean {
    const { shown, mesh } = this;
    if (!shown || !mesh.visible) return false;
    const column = Math.floor((x - mesh.position.x) / shown.step);
    const row = Math.floor((y - mesh.position.y) / shown.step);
    if (column < 0 || row < 0 || column >= shown.columns || row >= shown.rows) return false;
    const i = row * shown.columns + column;
    return ((shown.bits[i >> 3]! >> (i & 7)) & 1) === 1;
  }
}
