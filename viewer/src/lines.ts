// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";

/** One line: corners that the shader of LineMaterial moves to its ends. */
const kLine = new LineSegmentsGeometry();
const kCorners = kLine.getAttribute("position").count;

/**
 * Lines so many pixels wide. Their geometry changes, their material stays: three.js would compile its
 * shaders again for a new one.
 */
export function wide_lines(width: number): LineSegments2 {
  const lines = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ linewidth: width, vertexColors: true }));
  lines.frustumCulled = false;
  return lines;
}

/** `positions`, `colours`: three numbers of each end, two ends of each line. */
export function set_wide_lines(lines: LineSegments2, positions: Float32Array, colours: Float32Array): void {
  lines.geometry.dispose();
  lines.visible = positions.length > 0;
  lines.geometry = (lines.visible ? expanded(positions, colours) : new THREE.BufferGeometry()) as LineSegmentsGeometry;
}

/** The corners of all lines, in place of instances of one as three.js has them: software draws instances one by one, which takes 0.2 ms each. */
function expanded(positions: Float32Array, colours: Float32Array): THREE.BufferGeometry {
  const count = positions.length / 6;
  const geometry = new THREE.BufferGeometry();
  for (const name of ["position", "uv"]) {
    const { array, itemSize } = kLine.getAttribute(name) as THREE.BufferAttribute;
    const all = new Float32Array(count * array.length);
    for (let i = 0; i < count; ++i) all.set(array, i * array.length);
    geometry.setAttribute(name, new THREE.BufferAttribute(all, itemSize));
  }
  for (const [name, values, end] of [["instanceStart", positions, 0], ["instanceEnd", positions, 1], ["instanceColorStart", colours, 0], ["instanceColorEnd", colours, 1]] as const) {
    const all = new Float32Array(3 * kCorners * count);
    for (let corner = 0; corner < kCorners * count; ++corner) {
      const from = 6 * Math.floor(corner / kCorners) + 3 * end;
      for (let k = 0; k < 3; ++k) all[3 * corner + k] = values[from + k]!;
    }
    geometry.setAttribute(name, new THREE.BufferAttribute(all, 3));
  }
  const one = kLine.getIndex()!.array;
  const index = new Uint32Array(count * one.length);
  for (let i = 0; i < index.length; ++i) index[i] = one[i % one.length]! + kCorners * Math.floor(i / one.length);
  // By its middle what is transparent is sorted.
  geometry.boundingSphere = new THREE.Box3().setFromArray(positions).getBoundingSphere(new THREE.Sphere());
  return geometry.setIndex(new THREE.BufferAttribute(index, 1));
}

/** Lines one pixel wide. Of tens of thousands wide ones would take long in software. */
export function thin_lines(): THREE.LineSegments {
  const lines = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ vertexColors: true }));
  lines.frustumCulled = false;
  return lines;
}

export function set_thin_lines(lines: THREE.LineSegments, positions: Float32Array, colours: Float32Array): void {
  lines.geometry.dispose();
  lines.geometry = new THREE.BufferGeometry();
  lines.geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  lines.geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3));
}
