// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The scene as a block with its surface, and the probes (three.js).
import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  Color,
  DataTexture,
  DirectionalLight,
  DoubleSide,
  Line,
  LineBasicMaterial,
  LinearFilter,
  LinearMipmapLinearFilter,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  PerspectiveCamera,
  Raycaster,
  Scene,
  SRGBColorSpace,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';
import type { PictureFrame } from '../codec';
import { cameraTilt, frontPose, type CameraPose } from './camera';
import { Marble3d } from './marble3d';
import { Pace, type Speed } from './pace';
import type { Preferences } from '../settings/preferences';
import { Surface, type Place } from '../surface';
import { lookAlike, themeColours, type ProbeView, type View } from './view';

const fieldOfView = 32;
/** The picture's size relative to the block. */
const margin = 1.07;
const baseThickness = 0.002;
/** Least pixel ratio (pixels per CSS pixel). */
const coarsest = 0.5;

export class View3d implements View {
  readonly canvas = document.createElement('canvas');
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(fieldOfView, 1, 0.005, 10);
  private readonly sun = new DirectionalLight(0xffffff, 2.6);
  private marbles: Marble3d[] = [];
  private readonly traced = new Line(new BufferGeometry(), new LineBasicMaterial());
  private ground: Mesh | null = null;
  private walls: Mesh | null = null;
  private texture: DataTexture | null = null;
  private surface: Surface | null = null;
  /** What the middle of the picture shows. */
  private readonly target = new Vector3();
  private heightFactor = 1;
  private look: Pick<Preferences, 'surface' | 'tilt'> = { surface: 'picture', tilt: 25 };
  private shown: readonly ProbeView[] = [];
  private pose: CameraPose = frontPose;
  private stale = true;
  private pixelRatio = Math.min(2, window.devicePixelRatio);
  private readonly pace = new Pace();

  /** Throws if the browser has no WebGL. */
  constructor(container: HTMLElement) {
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, powerPreference: 'low-power' });
    this.renderer.setPixelRatio(this.pixelRatio);
    this.scene.add(new AmbientLight(0xffffff, 0.75), this.sun, this.traced);
    this.traced.visible = false;
    this.traced.frustumCulled = false;
    container.append(this.canvas);
  }

  show(surface: Surface, picture: PictureFrame | null): void {
    this.surface = surface;
    this.texture?.dispose();
    this.texture = picture && textureOf(picture, this.renderer.capabilities.getMaxAnisotropy());
    this.build();
  }

  set(heightFactor: number, look: Pick<Preferences, 'surface' | 'tilt'>): void {
    const rebuild = heightFactor !== this.heightFactor || look.surface !== this.look.surface;
    this.heightFactor = heightFactor;
    this.look = { ...look };
    if (rebuild) this.build();
    this.place();
    this.recolour();
  }

  aim(pose: CameraPose): void {
    this.pose = pose;
    this.place();
  }

  metresPerPixel(): number {
    const distance = this.camera.position.distanceTo(this.target);
    return (2 * distance * Math.tan((fieldOfView * Math.PI) / 360)) / (Math.max(1, this.canvas.clientHeight) * this.camera.zoom);
  }

  probes(probes: readonly ProbeView[]): boolean {
    if (lookAlike(this.shown, probes)) return false;
    this.shown = probes;
    while (this.marbles.length > probes.length) this.drop(this.marbles.pop()!);
    while (this.marbles.length < probes.length) this.add();
    this.showMarbles();
    return true;
  }

  line(points: readonly Place[]): void {
    const { surface } = this;
    if (surface === null) return;
    const above = 0.0004 * sizeOf(surface);
    const places = points.map((place) => new Vector3(place.x, place.y, surface.heightAt(place) * this.heightFactor + above));
    this.traced.geometry.dispose();
    this.traced.geometry = new BufferGeometry().setFromPoints(places);
    this.traced.visible = places.length > 1;
    this.stale = true;
  }

  placeAt(left: number, top: number): Place | null {
    if (this.surface === null) return null;
    const { clientWidth, clientHeight } = this.canvas;
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2((2 * left) / clientWidth - 1, 1 - (2 * top) / clientHeight), this.camera);
    return this.surface.hit(caster.ray.origin.toArray(), caster.ray.direction.toArray(), this.heightFactor);
  }

  resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.place();
    this.recolour();
  }

  draw(waited: number): Speed {
    if (!this.stale) return 'fine';
    this.stale = false;
    this.renderer.render(this.scene, this.camera);
    const speed = this.pace.drawn(waited);
    if (speed === 'fine' || this.pixelRatio <= coarsest) return speed === 'fine' ? 'fine' : 'too slow';
    // On a slow machine (often without a GPU) fewer pixels are better than fewer frames.
    this.pixelRatio = Math.max(coarsest, 0.7 * this.pixelRatio);
    this.renderer.setPixelRatio(this.pixelRatio);
    this.resize();
    return speed;
  }

  dispose(): void {
    this.texture?.dispose();
    for (const mesh of [this.ground, this.walls]) discard(mesh);
    for (const marble of this.marbles) marble.dispose();
    this.traced.geometry.dispose();
    this.traced.material.dispose();
    this.renderer.dispose();
    this.canvas.remove();
  }

  private add(): void {
    const { marble: colour, force } = themeColours(this.canvas);
    const marble = new Marble3d();
    marble.recolour(colour, force);
    this.marbles.push(marble);
    this.scene.add(marble.group);
  }

  private drop(marble: Marble3d): void {
    this.scene.remove(marble.group);
    marble.dispose();
  }

  private showMarbles(): void {
    const scale = this.surface ? sizeOf(this.surface) : 1;
    this.shown.forEach((probe, k) => this.marbles[k]?.show(probe, this.shown.length > 1, scale));
    this.stale = true;
  }

  /** Places the camera at the tilt angle so that the whole block is visible, then applies the pose. */
  private place(): void {
    if (this.surface === null) return;
    const tilt = (cameraTilt(this.look.tilt, this.surface) * Math.PI) / 180;
    const turn = (this.pose.turn * Math.PI) / 180;
    const size = sizeOf(this.surface);
    const upright = new Vector3(0, 0, 1);
    const { lowest, highest } = this.surface.range();
    const top = Math.max(0, lowest * this.heightFactor, highest * this.heightFactor);
    this.target.set(this.pose.centre.x, this.pose.centre.y, top / 2);
    const outwards = new Vector3(0, -Math.sin(tilt), Math.cos(tilt)).applyAxisAngle(upright, turn);
    const upwards = new Vector3(0, Math.cos(tilt), Math.sin(tilt)).applyAxisAngle(upright, turn);
    const sideways = new Vector3(1, 0, 0).applyAxisAngle(upright, turn);
    const half = Math.tan((fieldOfView * Math.PI) / 360) / margin;
    let distance = 0;
    for (const x of [-0.5, 0.5])
      for (const y of [-0.5, 0.5])
        for (const z of [-0.5, 0.5]) {
          const corner = new Vector3(x * this.surface.sizeX, y * this.surface.sizeY, z * (top + 2 * baseThickness * size));
          const needed = Math.max(Math.abs(corner.dot(sideways)) / this.camera.aspect, Math.abs(corner.dot(upwards))) / half;
          distance = Math.max(distance, corner.dot(outwards) + needed);
        }
    this.camera.near = 0.005 * size;
    this.camera.far = 10 * size;
    this.camera.zoom = this.pose.zoom;
    this.camera.position.copy(this.target).addScaledVector(outwards, distance);
    this.camera.up.copy(upwards);
    this.camera.lookAt(this.target);
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    this.sun.position.set(-0.5, 0.55, 0.75);
    this.stale = true;
  }

  private recolour(): void {
    const colours = themeColours(this.canvas);
    this.scene.background = new Color(colours.stage);
    for (const marble of this.marbles) marble.recolour(colours.marble, colours.force);
    this.traced.material.color.set(colours.force);
    for (const mesh of [this.ground, this.walls]) {
      const material = mesh?.material as MeshStandardMaterial | undefined;
      if (material && material.map === null) material.color.set(colours.clay);
    }
    this.stale = true;
  }

  private build(): void {
    for (const mesh of [this.ground, this.walls]) {
      if (mesh) this.scene.remove(mesh);
      discard(mesh);
    }
    if (this.surface === null) return;
    const map = this.look.surface === 'clay' ? null : this.texture;
    const material =
      this.look.surface === 'unlit' && map ? new MeshBasicMaterial({ map }) : new MeshStandardMaterial({ map, roughness: 0.85 });
    this.ground = new Mesh(groundOf(this.surface, this.heightFactor), material);
    this.walls = new Mesh(wallsOf(this.surface, this.heightFactor), new MeshStandardMaterial({ roughness: 0.9, side: DoubleSide }));
    this.scene.add(this.ground, this.walls);
    this.showMarbles();
    this.place();
    this.recolour();
  }
}

/** The scene's longer side in units of 0.1 m, which scales marbles, lines and the camera's range. */
function sizeOf({ sizeX, sizeY }: Surface): number {
  return Math.max(sizeX, sizeY) / 0.1;
}

function discard(mesh: Mesh | null): void {
  mesh?.geometry.dispose();
  (mesh?.material as MeshBasicMaterial | undefined)?.dispose();
}

function textureOf({ columns, rows, rgb }: PictureFrame, anisotropy: number): DataTexture {
  const rgba = new Uint8Array(columns * rows * 4);
  // Rows go upwards in a texture.
  for (let j = 0; j < rows; ++j)
    for (let i = 0; i < columns; ++i) {
      const from = 3 * (j * columns + i);
      rgba.set([rgb[from]!, rgb[from + 1]!, rgb[from + 2]!, 255], 4 * ((rows - 1 - j) * columns + i));
    }
  const texture = new DataTexture(rgba, columns, rows);
  texture.colorSpace = SRGBColorSpace;
  texture.magFilter = LinearFilter;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.anisotropy = anisotropy;
  texture.needsUpdate = true;
  return texture;
}

function groundOf(surface: Surface, heightFactor: number): BufferGeometry {
  const { columns, rows } = surface;
  const position = new Float32Array(columns * rows * 3);
  const uv = new Float32Array(columns * rows * 2);
  const index = new Uint32Array((columns - 1) * (rows - 1) * 6);
  for (let j = 0; j < rows; ++j)
    for (let i = 0; i < columns; ++i) {
      const k = j * columns + i;
      position.set([surface.xOf(i), surface.yOf(j), surface.at(i, j) * heightFactor], 3 * k);
      uv.set([(i + 0.5) / columns, 1 - (j + 0.5) / rows], 2 * k);
    }
  let at = 0;
  for (let j = 0; j + 1 < rows; ++j)
    for (let i = 0; i + 1 < columns; ++i) {
      const k = j * columns + i;
      index.set([k, k + columns, k + 1, k + 1, k + columns, k + columns + 1], at);
      at += 6;
    }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(position, 3));
  geometry.setAttribute('uv', new BufferAttribute(uv, 2));
  geometry.setIndex(new BufferAttribute(index, 1));
  geometry.computeVertexNormals();
  return geometry;
}

/** The sides of the block, from the surface's rim down to the base. */
function wallsOf(surface: Surface, heightFactor: number): BufferGeometry {
  const { columns, rows } = surface;
  const rim: [number, number][] = [];
  for (let i = 0; i < columns - 1; ++i) rim.push([i, rows - 1]);
  for (let j = rows - 1; j > 0; --j) rim.push([columns - 1, j]);
  for (let i = columns - 1; i > 0; --i) rim.push([i, 0]);
  for (let j = 0; j < rows; ++j) rim.push([0, j]);
  const { lowest, highest } = surface.range();
  const floor = Math.min(lowest * heightFactor, highest * heightFactor) - baseThickness * sizeOf(surface);
  const position = new Float32Array(rim.length * 6);
  const index: number[] = [];
  rim.forEach(([i, j], k) => {
    const [x, y] = [surface.xOf(i), surface.yOf(j)];
    position.set([x, y, surface.at(i, j) * heightFactor, x, y, floor], 6 * k);
    if (k > 0) index.push(2 * k - 2, 2 * k - 1, 2 * k, 2 * k, 2 * k - 1, 2 * k + 1);
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(position, 3));
  geometry.setIndex(index);
  geometry.computeVertexNormals();
  return geometry;
}
