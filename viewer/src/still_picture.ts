// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
import * as THREE from "three";

const kVertex = `
void main() {
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;
const kFragment = `
uniform sampler2D picture;
uniform highp sampler2D depths;
uniform float ratio;
out vec4 colour;
void main() {
  vec2 place = ratio * gl_FragCoord.xy;
  ivec2 at = ivec2(place);
  colour = ratio == 1.0 ? texelFetch(picture, at, 0) : texture(picture, place / vec2(textureSize(picture, 0)));
  gl_FragDepth = texelFetch(depths, at, 0).r;
}`;

/**
 * A scene as it was drawn once, with its depths: what is drawn over it is hidden by it all the same.
 * It can be put on a canvas of fewer pixels, too.
 */
export class StillPicture {
  private readonly target = new THREE.WebGLRenderTarget(1, 1, { depthTexture: new THREE.DepthTexture(1, 1, THREE.UnsignedIntType) });
  private readonly camera = new THREE.Camera();
  private readonly sheet: THREE.Mesh<THREE.BufferGeometry, THREE.ShaderMaterial>;

  constructor() {
    const material = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: kVertex,
      fragmentShader: kFragment,
      depthFunc: THREE.AlwaysDepth,
      uniforms: { picture: { value: this.target.texture }, depths: { value: this.target.depthTexture }, ratio: { value: 1 } },
    });
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    this.sheet = new THREE.Mesh(geometry, material);
    this.sheet.frustumCulled = false;
  }

  /** Its pixels from left to right. */
  get width(): number {
    return this.target.width;
  }

  /** Draws a scene, of the size that the renderer has. */
  take(renderer: THREE.WebGLRenderer, scene: THREE.Scene, camera: THREE.Camera): void {
    const { x, y } = renderer.getDrawingBufferSize(new THREE.Vector2());
    if (this.target.width !== x || this.target.height !== y) this.target.setSize(x, y);
    renderer.setRenderTarget(this.target);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
  }

  /** The picture that was taken, colours and depths, in place of all that is there. */
  put(renderer: THREE.WebGLRenderer): void {
    this.sheet.material.uniforms.ratio!.value = this.width / renderer.getDrawingBufferSize(new THREE.Vector2()).x;
    renderer.render(this.sheet, this.camera);
  }
}
