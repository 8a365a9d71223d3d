// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The scene as a block with its surface, and the probes (three.js).
import {
  AmbientLight,
  BufferGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  Group,
  Line,
  LineBasicMaterial,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  PerspectiveCamera,
  Quaternion,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
  type DataTexture,
} from 'three';
import type { PictureFrame } from '../codec';
import { cornerOnScreen, cssPixel } from '../settings/screen_size';
import { Surface, type Place } from '../surface';
import { baseThickness, discard, groundOf, sizeOf, textureOf, wallsOf } from './block';
import { cameraTilt, frontPose, type CameraPose } from './camera';
import { DepthPicture, turnOf } from './depth/depth_picture';
import { fitByHand, fitOf, type Fit } from './depth/fit';
import type { ScreenPoint, Size } from './depth/frustum';
import { restingHead } from './depth/head';
import { inScene, type Registration } from './depth/registration';
import { Headset } from './headset/headset';
import { fillsCanvas, inWindow, layouts, usedShare, windowOf, type Layout } from './depth/layout';
import { Marble3d, marbleRadius } from './marble3d';
import { Pace, type Speed } from './pace';
import { leftEye, rightEyeMesh, type SecondView } from './second_view';
import { lookAlike, plainLook, themeColours, type Look, type ProbeView, type View } from './view';

const fieldOfView = 32;
/** The picture's size relative to the block. */
const margin = 1.07;
/** Least pixel ratio (pixels per CSS pixel). */
const coarsest = 0.5;

export class View3d implements View {
  readonly canvas = document.createElement('canvas');
  private readonly renderer: WebGLRenderer;
  readonly headset: Headset;
  private readonly scene = new Scene();
  /** What is in the scene's frame: all but the controllers of a headset. */
  private readonly block = new Group();
  private readonly camera = new PerspectiveCamera(fieldOfView, 1, 0.005, 10);
  private readonly sun = new DirectionalLight(0xffffff, 2.6);
  private marbles: Marble3d[] = [];
  private readonly traced = new Line(new BufferGeometry(), new LineBasicMaterial());
  private ground: Mesh | null = null;
  private walls: Mesh | null = null;
  /** The ground for the right eye alone; null: it sees the same. */
  private rightGround: Mesh | null = null;
  private second: SecondView | null = null;
  private secondTexture: DataTexture | null = null;
  private texture: DataTexture | null = null;
  private surface: Surface | null = null;
  /** What the middle of the picture shows. */
  private readonly target = new Vector3();
  private heightFactor = 1;
  private look: Look = plainLook;
  private shown: readonly ProbeView[] = [];
  private pose: CameraPose = frontPose;
  private stale = true;
  private pixelRatio = Math.min(2, window.devicePixelRatio);
  private readonly pace = new Pace();
  private readonly depth: DepthPicture;
  private onScreen: Fit | null = null;
  private headMoved = restingHead;
  private registration: Registration | null = null;
  /** The share of the canvas's width that the pictures for both eyes take. */
  private used = 1;

  /** Throws if the browser has no WebGL. */
  constructor(container: HTMLElement) {
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, powerPreference: 'low-power' });
    this.renderer.setPixelRatio(this.pixelRatio);
    // A usual picture is that of the left eye.
    this.camera.layers.enable(leftEye);
    this.depth = new DepthPicture(this.renderer);
    this.block.add(this.sun, this.sun.target, this.traced);
    this.scene.add(new AmbientLight(0xffffff, 0.75), this.block);
    this.headset = new Headset(this.renderer, this.scene, this.block, () => this.resize());
    this.traced.visible = false;
    this.traced.frustumCulled = false;
    container.append(this.canvas);
  }

  get fit(): Fit | null {
    return this.onScreen;
  }

  show(surface: Surface, picture: PictureFrame | null, second: SecondView | null = null): void {
    this.surface = surface;
    const anisotropy = this.renderer.capabilities.getMaxAnisotropy();
    this.texture?.dispose();
    this.texture = picture && textureOf(picture, anisotropy);
    this.second = second;
    this.secondTexture?.dispose();
    this.secondTexture = second && textureOf(second.picture, anisotropy);
    this.build();
  }

  set(heightFactor: number, look: Look): void {
    const rebuild = heightFactor !== this.heightFactor || look.surface !== this.look.surface || look.secondView !== this.look.secondView;
    const resample = look.depthMode !== this.look.depthMode;
    this.heightFactor = heightFactor;
    this.look = { ...look };
    this.headset.setSize(look.headsetSize);
    if (rebuild) this.build();
    if (resample) this.resize();
    this.place();
    this.recolour();
  }

  head(moved: ScreenPoint): void {
    this.headMoved = moved;
    this.place();
  }

  register(registration: Registration | null): void {
    this.registration = registration;
    this.place();
  }

  aim(pose: CameraPose): void {
    this.pose = pose;
    this.place();
  }

  metresPerPixel(): number {
    if (this.fit !== null) return this.pixel() / this.fit.scale;
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
    const { layout } = this;
    const share = { across: left / clientWidth, down: top / clientHeight };
    const { across, down } = layout === null ? share : inWindow(layout, share.across, share.down, this.used);
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2(2 * across - 1, 1 - 2 * down), layout === null ? this.camera : this.depth.middle);
    return this.surface.hit(caster.ray.origin.toArray(), caster.ray.direction.toArray(), this.heightFactor);
  }

  resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (this.headset.isShowing || clientWidth === 0 || clientHeight === 0) return;
    // Interleaved lines are those of the screen.
    this.renderer.setPixelRatio(this.isInterleaved ? window.devicePixelRatio : this.pixelRatio);
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.place();
    this.recolour();
  }

  draw(waited: number): Speed {
    if (this.headset.draw() || !this.stale) return 'fine';
    this.stale = false;
    if (this.layout === null) this.renderer.render(this.scene, this.camera);
    else this.depth.draw(this.scene, this.layout, this.used, this.look.swapEyes, this.corner());
    const speed = this.pace.drawn(waited);
    if (speed === 'fine' || this.pixelRatio <= coarsest || this.isInterleaved) return speed === 'fine' ? 'fine' : 'too slow';
    // On a slow machine (often without a GPU) fewer pixels are better than fewer frames.
    this.pixelRatio = Math.max(coarsest, 0.7 * this.pixelRatio);
    this.resize();
    return speed;
  }

  dispose(): void {
    this.headset.dispose();
    this.texture?.dispose();
    this.secondTexture?.dispose();
    for (const mesh of [this.ground, this.walls, this.rightGround]) discard(mesh);
    for (const marble of this.marbles) marble.dispose();
    this.traced.geometry.dispose();
    this.traced.material.dispose();
    this.depth.dispose();
    this.renderer.dispose();
    this.canvas.remove();
  }

  private add(): void {
    const { marble: colour, force } = themeColours(this.canvas);
    const marble = new Marble3d();
    marble.recolour(colour, force);
    this.marbles.push(marble);
    this.block.add(marble.group);
  }

  private drop(marble: Marble3d): void {
    this.block.remove(marble.group);
    marble.dispose();
  }

  private showMarbles(): void {
    const scale = this.surface ? sizeOf(this.surface) : 1;
    this.shown.forEach((probe, k) => this.marbles[k]?.show(probe, this.shown.length > 1, scale));
    this.stale = true;
  }

  private get layout(): Layout | null {
    return this.look.depthMode === 'plain' ? null : layouts[this.look.depthMode];
  }
  private get isInterleaved(): boolean {
    const by = this.layout?.mixing?.by;
    return by === 'rows' || by === 'columns';
  }

  /** Metres of the screen per CSS pixel. */
  private pixel(): number {
    return cssPixel(this.look.pixelSize, window.devicePixelRatio) / 1000;
  }

  /** The device pixel of the screen at the canvas's upper left corner. */
  private corner(): { left: number; top: number } {
    const { left, top } = cornerOnScreen(this.canvas);
    return { left: Math.round(left * window.devicePixelRatio), top: Math.round(top * window.devicePixelRatio) };
  }

  /** Places the camera or the eyes at the tilt angle so that the whole block is visible, then applies the pose. */
  private place(): void {
    if (this.surface === null) return;
    this.headset.follow(this.surface, this.heightFactor, this.pose);
    const tilt = (cameraTilt(this.look.tilt, this.surface) * Math.PI) / 180;
    const turn = (this.pose.turn * Math.PI) / 180;
    const upright = new Vector3(0, 0, 1);
    const { lowest, highest } = this.surface.range();
    const low = Math.min(lowest * this.heightFactor, highest * this.heightFactor);
    const top = Math.max(0, lowest * this.heightFactor, highest * this.heightFactor);
    this.target.set(this.pose.centre.x, this.pose.centre.y, top / 2);
    const axes = {
      sideways: new Vector3(1, 0, 0).applyAxisAngle(upright, turn),
      upwards: new Vector3(0, Math.cos(tilt), Math.sin(tilt)).applyAxisAngle(upright, turn),
      outwards: new Vector3(0, -Math.sin(tilt), Math.cos(tilt)).applyAxisAngle(upright, turn),
    };
    if (this.layout === null) this.placeCamera(this.surface, axes, top);
    else this.placeEyes(this.surface, axes, this.layout, low, top);
    this.sun.position.set(-0.5, 0.55, 0.75);
    this.stale = true;
  }

  private placeCamera(surface: Surface, { sideways, upwards, outwards }: Axes, top: number): void {
    const size = sizeOf(surface);
    const half = Math.tan((fieldOfView * Math.PI) / 360) / margin;
    const beyond = (top + 2 * baseThickness * size) / 2;
    let distance = 0;
    for (const corner of cornersOf(surface, -beyond, beyond)) {
      const needed = Math.max(Math.abs(corner.dot(sideways)) / this.camera.aspect, Math.abs(corner.dot(upwards))) / half;
      distance = Math.max(distance, corner.dot(outwards) + needed);
    }
    this.onScreen = null;
    this.camera.near = 0.005 * size;
    this.camera.far = 10 * size;
    this.camera.zoom = this.pose.zoom;
    this.camera.position.copy(this.target).addScaledVector(outwards, distance);
    this.camera.up.copy(upwards);
    this.camera.lookAt(this.target);
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }

  /** The screen is a plane of the scene, at right angles to `outwards`; the block with a marble on it is in view. */
  private placeEyes(surface: Surface, { sideways, upwards, outwards }: Axes, layout: Layout, low: number, top: number): void {
    const size = sizeOf(surface);
    const [eyeDistance, distance] = [this.look.eyeDistance / 1000, this.look.screenDistance / 1000];
    const head = { ...this.headMoved, z: distance + this.headMoved.z };
    const pixel = this.pixel();
    const canvas = { width: pixel * this.canvas.clientWidth, height: pixel * this.canvas.clientHeight };
    this.used = usedShare(layout, canvas.width, { distance, eyeDistance });
    const window = windowOf(layout, canvas, this.used);
    if (this.registration !== null && fillsCanvas(layout)) return this.placeByHand(this.registration, surface, { low, top, head, window });
    const corners = cornersOf(surface, low - baseThickness * size - top / 2, top / 2 + 2 * marbleRadius * size);
    const fit = fitOf(
      corners.map((corner) => ({ x: corner.dot(sideways), y: corner.dot(upwards), z: corner.dot(outwards) })),
      window,
      { distance, eyeDistance },
      {
        before: this.look.depthBefore / 100,
        depth: this.look.depthShare / 100,
        comfort: this.look.depthComfort,
        zoom: this.pose.zoom,
        headDistance: head.z,
      },
    );
    this.onScreen = fit;
    // Shifted pictures keep their plane in the screen's.
    const shift = this.pose.centre.x * outwards.x + this.pose.centre.y * outwards.y;
    const origin = this.target.clone().addScaledVector(outwards, fit.plane - shift);
    const turn = turnOf(sideways, upwards, outwards, new Quaternion());
    this.depth.aim({ origin, turn, fit, window, sceneSize: size }, head, eyeDistance);
  }

  /** The scene is where the hand feels it: the picture's place on the screen counts, its turn and zoom do not. */
  private placeByHand(registration: Registration, surface: Surface, { low, top, head, window }: { low: number; top: number; head: ScreenPoint; window: Size }): void {
    const { right, up, towards } = registration;
    const size = sizeOf(surface);
    const eyeDistance = this.look.eyeDistance / 1000;
    const fit = fitByHand(cornersOf(surface, low - baseThickness * size, top), { distance: head.z, eyeDistance }, registration);
    this.onScreen = fit;
    const { left, top: above } = cornerOnScreen(this.canvas);
    const pixel = this.pixel();
    const middle = inScene({ x: left * pixel + window.width / 2, y: -above * pixel - window.height / 2, z: 0 }, registration);
    const axes = [right, up, towards].map(({ x, y, z }) => new Vector3(x, y, z)) as [Vector3, Vector3, Vector3];
    const origin = new Vector3(middle.x, middle.y, middle.z);
    this.depth.aim({ origin, turn: turnOf(...axes, new Quaternion()), fit, window, sceneSize: size }, head, eyeDistance);
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
    for (const mesh of [this.ground, this.walls, this.rightGround]) {
      if (mesh) this.block.remove(mesh);
      discard(mesh);
    }
    this.rightGround = null;
    if (this.surface === null) return;
    const map = this.look.surface === 'clay' ? null : this.texture;
    const material =
      this.look.surface === 'unlit' && map ? new MeshBasicMaterial({ map }) : new MeshStandardMaterial({ map, roughness: 0.85 });
    const ground = new Mesh(groundOf(this.surface, this.heightFactor), material);
    this.ground = ground;
    if (map && this.second && this.secondTexture && this.look.secondView) {
      this.rightGround = rightEyeMesh(ground, this.surface, this.second, this.secondTexture);
      this.block.add(this.rightGround);
    }
    this.walls = new Mesh(wallsOf(this.surface, this.heightFactor), new MeshStandardMaterial({ roughness: 0.9, side: DoubleSide }));
    this.block.add(this.ground, this.walls);
    this.showMarbles();
    this.place();
    this.recolour();
  }
}

/** The view's axes in the scene; outwards: towards the person. */
interface Axes {
  sideways: Vector3;
  upwards: Vector3;
  outwards: Vector3;
}

/** The corners of a block over the surface's rectangle. */
function cornersOf({ sizeX, sizeY }: Surface, low: number, high: number): Vector3[] {
  return [-0.5, 0.5].flatMap((x) => [-0.5, 0.5].flatMap((y) => [low, high].map((z) => new Vector3(x * sizeX, y * sizeY, z))));
}
