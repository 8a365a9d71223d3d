// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Draws a scene for two eyes: one camera each, and both pictures beside one another or mixed (three.js).
import {
  LinearFilter,
  Matrix3,
  Matrix4,
  Mesh,
  OrthographicCamera,
  PerspectiveCamera,
  PlaneGeometry,
  Scene,
  ShaderMaterial,
  SRGBColorSpace,
  Vector2,
  Vector3,
  WebGLRenderTarget,
  type Color,
  type Quaternion,
  type WebGLRenderer,
} from 'three';
import { eyeInScene, type Fit } from './fit';
import { eyesOf, offAxis, type ScreenPoint, type Size } from './frustum';
import { partsOf, type Layout, type Mixing } from './layout';
import { leftEye, rightEye } from '../second_view';

/** Where the screen is in the scene. */
export interface Screen {
  /** The middle of the picture. */
  origin: Vector3;
  /** Turns the screen's axes into those of the scene. */
  turn: Quaternion;
  fit: Fit;
  /** In metres of the screen. */
  window: Size;
  /** The size of what is drawn in units of 0.1 m, for the near and far planes. */
  sceneSize: number;
}

export class DepthPicture {
  /** From the head's place, for pointing. */
  readonly middle = new PerspectiveCamera();
  private readonly eyes = { left: new PerspectiveCamera(), right: new PerspectiveCamera() };
  private mixer: Mixer | null = null;

  constructor(private readonly renderer: WebGLRenderer) {
    for (const camera of [this.middle, this.eyes.left]) camera.layers.enable(leftEye);
    this.eyes.right.layers.enable(rightEye);
  }

  aim(screen: Screen, head: ScreenPoint, eyeDistance: number): void {
    const [left, right] = eyesOf(head, eyeDistance);
    aimCamera(this.middle, screen, head);
    aimCamera(this.eyes.left, screen, left);
    aimCamera(this.eyes.right, screen, right);
  }

  /** `used`: the pictures' share of the width. `swap`: exchanges the eyes. `corner`: the device pixel of the screen at the canvas's upper left corner. */
  draw(scene: Scene, layout: Layout, used: number, swap: boolean, corner: { left: number; top: number }): void {
    if (layout.first === 'head') return this.renderer.render(scene, this.middle);
    const { left, right } = this.eyes;
    const pair = (layout.first === 'left') !== swap ? [left, right] : [right, left];
    if (layout.mixing === null) return this.drawParts(scene, layout, used, pair);
    this.mixer ??= new Mixer();
    this.mixer.draw(this.renderer, scene, pair, layout.mixing, corner);
  }

  dispose(): void {
    this.mixer?.dispose();
  }

  private drawParts(scene: Scene, layout: Layout, used: number, pair: readonly PerspectiveCamera[]): void {
    const { renderer } = this;
    const size = renderer.getDrawingBufferSize(new Vector2());
    const ratio = renderer.getPixelRatio();
    if (used < 1) {
      renderer.setClearColor(scene.background as Color);
      renderer.clear();
    }
    renderer.setScissorTest(true);
    partsOf(layout, size.x, size.y, used).forEach(({ left, top, width, height }, k) => {
      const box = [left / ratio, (size.y - top - height) / ratio, width / ratio, height / ratio] as const;
      renderer.setViewport(...box);
      renderer.setScissor(...box);
      renderer.render(scene, pair[k]!);
    });
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, size.x / ratio, size.y / ratio);
  }
}

function aimCamera(camera: PerspectiveCamera, { origin, turn, fit, window, sceneSize }: Screen, eye: ScreenPoint): void {
  const from = eyeInScene(eye, fit);
  const { left, right, bottom, top, near, far } = offAxis(
    from,
    { width: window.width / fit.scale, height: window.height / fit.scale },
    Math.max(0.02 * from.z, 0.005 * sceneSize),
    from.z + 10 * sceneSize,
  );
  camera.position.set(from.x, from.y, from.z).applyQuaternion(turn).add(origin);
  camera.quaternion.copy(turn);
  camera.projectionMatrix.makePerspective(left, right, top, bottom, near, far);
  camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
  camera.updateMatrixWorld();
}

const kinds = { colours: 0, rows: 1, columns: 2 } as const;

/** Draws both eyes' pictures, then one picture of both. */
class Mixer {
  // Linear values, stored as sRGB so that eight bits suffice.
  private readonly targets = [0, 1].map(() => {
    const target = new WebGLRenderTarget(1, 1, { samples: 4, minFilter: LinearFilter, magFilter: LinearFilter });
    target.texture.colorSpace = SRGBColorSpace;
    return target;
  });
  private readonly material = new ShaderMaterial({
    uniforms: {
      first: { value: this.targets[0]!.texture },
      second: { value: this.targets[1]!.texture },
      fromFirst: { value: new Matrix3() },
      fromSecond: { value: new Matrix3() },
      kind: { value: 0 },
      height: { value: 1 },
      corner: { value: new Vector2() },
    },
    vertexShader: 'varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }',
    fragmentShader: `
      uniform sampler2D first, second;
      uniform mat3 fromFirst, fromSecond;
      uniform int kind;
      uniform float height;
      uniform vec2 corner;
      varying vec2 at;
      void main() {
        vec3 one = texture2D(first, at).rgb;
        vec3 other = texture2D(second, at).rgb;
        float line = kind == ${kinds.rows} ? floor(height - gl_FragCoord.y) + corner.y : floor(gl_FragCoord.x) + corner.x;
        vec3 mixed = kind == ${kinds.colours} ? clamp(fromFirst * one + fromSecond * other, 0.0, 1.0) : mod(line, 2.0) < 0.5 ? one : other;
        gl_FragColor = vec4(mixed, 1.0);
        #include <colorspace_fragment>
      }`,
    depthTest: false,
    depthWrite: false,
  });
  private readonly quad = new Mesh(new PlaneGeometry(2, 2), this.material);
  private readonly stage = new Scene().add(this.quad);
  private readonly camera = new OrthographicCamera();

  constructor() {
    this.quad.frustumCulled = false;
  }

  draw(renderer: WebGLRenderer, scene: Scene, pair: readonly PerspectiveCamera[], mixing: Mixing, corner: { left: number; top: number }): void {
    const size = renderer.getDrawingBufferSize(new Vector2());
    this.targets.forEach((target, k) => {
      if (target.width !== size.x || target.height !== size.y) target.setSize(size.x, size.y);
      renderer.setRenderTarget(target);
      renderer.render(scene, pair[k]!);
    });
    renderer.setRenderTarget(null);
    const { uniforms } = this.material;
    if (mixing.by === 'colours') {
      (uniforms.fromFirst!.value as Matrix3).set(...mixing.glasses.left);
      (uniforms.fromSecond!.value as Matrix3).set(...mixing.glasses.right);
    }
    uniforms.kind!.value = kinds[mixing.by];
    uniforms.height!.value = size.y;
    (uniforms.corner!.value as Vector2).set(corner.left, corner.top);
    renderer.render(this.stage, this.camera);
  }

  dispose(): void {
    for (const target of this.targets) target.dispose();
    this.quad.geometry.dispose();
    this.material.dispose();
  }
}

/** The turn of the screen whose axes point along these directions of the scene. */
export const turnOf = (sideways: Vector3, upwards: Vector3, outwards: Vector3, into: Quaternion): Quaternion =>
  into.setFromRotationMatrix(new Matrix4().makeBasis(sideways, upwards, outwards));
