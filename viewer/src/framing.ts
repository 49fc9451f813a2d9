// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";

// How a box is brought into view.

export function corners_of({ min, max }: THREE.Box3): THREE.Vector3[] {
  return [0, 1, 2, 3, 4, 5, 6, 7].map((corner) => new THREE.Vector3(corner & 1 ? max.x : min.x, corner & 2 ? max.y : min.y, corner & 4 ? max.z : min.z));
}

/** How far back from a place a camera sees all of a box, `back` being the way from what it looks at. */
export function distance_to_see_all(camera: THREE.PerspectiveCamera, aspect: number, box: THREE.Box3, place: THREE.Vector3, back: THREE.Vector3): number {
  const kRoom = 1.03;
  const slope = Math.tan(THREE.MathUtils.degToRad(camera.fov / 2)) / kRoom;
  const right = new THREE.Vector3().crossVectors(camera.up, back).normalize();
  const up = new THREE.Vector3().crossVectors(back, right);
  let distance = 0;
  for (const corner of corners_of(box)) {
    const from = corner.sub(place);
    const beside = Math.max(Math.abs(from.dot(right)) / (slope * aspect), Math.abs(from.dot(up)) / slope);
    distance = Math.max(distance, beside + from.dot(back));
  }
  return distance;
}

/** How far to the right, pixels, a box between `left` and `right` is moved so that nothing lies over it, as far as there is room. */
export function step_aside(left: number, right: number, covered: number, width: number): number {
  const kGap = 8;
  return Math.max(0, Math.min(covered + kGap - left, width - kGap - right));
}
