// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Shows the 3D view's scene in a headset (WebXR): its session, its frames, and where the scene stands.
import { Color, Matrix4, PerspectiveCamera, Quaternion, Vector3, type Group, type Scene, type WebGLRenderer } from 'three';
import type { Surface } from '../../surface';
import { frontPose, type CameraPose } from '../camera';
import { themeColours } from '../view';
import { Controllers, inScene, type ControllersTarget, type Pointed } from './controllers';
import { before, carried, sceneToRoom, usualScale, type Pose, type Standing } from './standing';
import { faultOf, type HeadsetFault, type HeadsetMode } from './support';

export interface HeadsetTarget extends Pick<ControllersTarget, 'aim' | 'press' | 'release'> {
  /** Whether the headset asks for the page's frames now; else the browser's window does. */
  drives(headset: boolean): void;
  /** A frame of the headset: draw() must be called. */
  frame(): void;
  /** Whoever ended it: the page, the person, or the headset that was lost. */
  ended(): void;
}

/** What is near and far, metres of the room. */
const near = 0.02;
const far = 50;

export class Headset {
  private readonly camera = new PerspectiveCamera(60, 1, near, far);
  private readonly controllers: Controllers;
  private session: XRSession | null = null;
  private target: HeadsetTarget | null = null;
  private standing: Standing | null = null;
  private surface: Surface | null = null;
  private heightFactor = 1;
  private pose: CameraPose = frontPose;
  /** Per cent of the usual size. */
  private size = 100;
  private inFrame = false;
  private isGone = false;

  /** `block` holds what stands in the scene's frame; `left`: the view belongs to the screen again. */
  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly scene: Scene,
    private readonly block: Group,
    private readonly left: () => void,
  ) {
    block.matrixAutoUpdate = false;
    this.controllers = new Controllers(renderer.xr, {
      pointed: (origin, direction) => this.pointed(origin, direction),
      size: () => (this.surface ? Math.max(this.surface.sizeX, this.surface.sizeY) : 1),
      aim: (pointer, place) => this.target?.aim(pointer, place),
      press: (pointer, place) => this.target?.press(pointer, place),
      release: (pointer) => this.target?.release(pointer),
    });
    renderer.xr.addEventListener('sessionend', () => this.ended());
  }

  get isShowing(): boolean {
    return this.renderer.xr.isPresenting;
  }
  /** Of the controllers that move probes. */
  get pads(): Gamepad[] {
    return this.controllers.pads;
  }
  /** Where it stands; null before the first frame. */
  get stands(): Standing | null {
    return this.standing;
  }

  /** Call it from a user action. The result: null, or why the scene is not shown. */
  async show(mode: HeadsetMode, target: HeadsetTarget): Promise<HeadsetFault | null> {
    const { xr } = this.renderer;
    let session: XRSession | null = null;
    try {
      session = await navigator.xr!.requestSession(mode);
      this.standing = null;
      this.target = target;
      xr.enabled = true;
      xr.setReferenceSpaceType('local');
      // Before the session, whose beginning stops the window's frames of this loop.
      this.renderer.setAnimationLoop((time: number, frame?: XRFrame) => this.frame(time, frame));
      await xr.setSession(session);
      if (this.isGone || !xr.isPresenting) throw new Error('it has ended meanwhile');
    } catch (error) {
      this.renderer.setAnimationLoop(null);
      xr.enabled = false;
      this.target = null;
      void session?.end().catch(() => undefined);
      return faultOf(error);
    }
    this.session = session;
    session.addEventListener('visibilitychange', () => this.drive());
    xr.getReferenceSpace()?.addEventListener('reset', () => this.again());
    this.controllers.enter(this.scene, new Color(themeColours(this.renderer.domElement).force));
    this.drive();
    return null;
  }

  leave(): void {
    void this.session?.end().catch(() => undefined);
  }
  /** Puts the scene before the person again. */
  again(): void {
    this.standing = null;
  }

  follow(surface: Surface, heightFactor: number, pose: CameraPose): void {
    this.surface = surface;
    this.heightFactor = heightFactor;
    this.pose = pose;
  }
  /** Per cent of the usual size. */
  setSize(size: number): void {
    if (this.standing !== null) this.standing = { ...this.standing, scale: (this.standing.scale * size) / this.size };
    this.size = size;
  }

  /** False: the screen must be drawn instead. */
  draw(): boolean {
    if (this.inFrame) this.renderer.render(this.scene, this.camera);
    return this.isShowing;
  }

  dispose(): void {
    this.isGone = true;
    this.leave();
    this.controllers.dispose();
  }

  private frame(time: number, frame: XRFrame | undefined): void {
    const space = this.renderer.xr.getReferenceSpace();
    const eyes = space && frame?.getViewerPose(space);
    if (!eyes || this.surface === null) return;
    this.stand(this.surface, poseOf(eyes.transform));
    const carry = this.controllers.frame(time);
    if (carry !== null) this.standing = carried(this.standing!, carry.from, carry.now, usualScale(this.surface));
    this.inFrame = true;
    this.target?.frame();
    this.inFrame = false;
  }

  private stand(surface: Surface, eyes: Pose): void {
    this.standing ??= before(eyes, surface, (usualScale(surface) * this.size) / 100);
    this.place(sceneToRoom(this.standing, this.pose, surface));
  }
  private place(toRoom: Matrix4): void {
    this.block.matrix.copy(toRoom);
    this.block.matrixWorldNeedsUpdate = true;
  }

  private pointed(origin: Vector3, direction: Vector3): Pointed | null {
    const { surface } = this;
    if (surface === null) return null;
    const ray = inScene(origin, direction, this.block.matrix);
    const place = surface.hit(ray.origin.toArray(), ray.direction.toArray(), this.heightFactor);
    if (place === null || !surface.contains(place)) return null;
    const there = new Vector3(place.x, place.y, surface.heightAt(place) * this.heightFactor);
    return { ...place, distance: there.applyMatrix4(this.block.matrix).distanceTo(origin) };
  }

  /** A headset that was taken off gives no frames: the window's go on. */
  private drive(): void {
    this.target?.drives(this.session !== null && this.session.visibilityState !== 'hidden');
  }

  private ended(): void {
    const { target } = this;
    // Three.js goes on to ask for the window's frames, for as long as there is a loop.
    this.renderer.setAnimationLoop(null);
    this.renderer.xr.enabled = false;
    this.session = this.standing = null;
    this.controllers.leave(this.scene);
    this.place(new Matrix4());
    this.left();
    this.target = null;
    target?.drives(false);
    target?.ended();
  }
}

function poseOf({ position, orientation }: XRRigidTransform): Pose {
  return {
    place: new Vector3(position.x, position.y, position.z),
    turned: new Quaternion(orientation.x, orientation.y, orientation.z, orientation.w),
  };
}
