// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The controllers of a headset: their rays move probes, and their handles carry the scene.
import { BufferGeometry, Line, LineBasicMaterial, Matrix4, Quaternion, Vector3, type Color, type Scene, type WebXRManager, type XRTargetRaySpace } from 'three';
import type { Place } from '../../surface';
import { PointingRest } from './pointing_rest';
import type { Pose } from './standing';

export interface Pointed extends Place {
  /** From the controller, metres of the room. */
  distance: number;
}

export interface ControllersTarget {
  /** Where a ray of the room meets the scene; null if it misses it. */
  pointed(origin: Vector3, direction: Vector3): Pointed | null;
  /** The scene's longer side, metres. */
  size(): number;
  aim(pointer: number, place: Place): void;
  press(pointer: number, place: Place): void;
  release(pointer: number): void;
}

/** Pointers of the page have numbers above. */
const firstPointer = -10;
/** Of a ray that misses the scene, metres. */
const farRay = 1;

class Controller {
  readonly ray = new Line(new BufferGeometry().setFromPoints([new Vector3(), new Vector3(0, 0, -1)]), new LineBasicMaterial());
  readonly rest = new PointingRest();
  source: XRInputSource | null = null;
  /** The trigger moves a probe; something carries the scene. */
  presses = false;
  carries = false;

  constructor(
    readonly group: XRTargetRaySpace,
    readonly pointer: number,
  ) {
    this.ray.frustumCulled = false;
    group.add(this.ray);
  }

  get isTracked(): boolean {
    return this.source !== null && this.group.visible;
  }
  get pose(): Pose {
    const [place, turned] = [new Vector3(), new Quaternion()];
    this.group.matrix.decompose(place, turned, new Vector3());
    return { place, turned };
  }
}

export class Controllers {
  private readonly all: Controller[];
  /** The one whose ray moves the probe without its trigger: the one used last. */
  private first = 0;
  /** Where the hands that carry were last. */
  private carrying: Pose[] = [];

  constructor(
    xr: WebXRManager,
    private readonly target: ControllersTarget,
  ) {
    this.all = [0, 1].map((k) => this.bound(new Controller(xr.getController(k), firstPointer - k), k));
  }

  enter(scene: Scene, colour: Color): void {
    for (const { group, ray } of this.all) {
      ray.material.color.copy(colour);
      scene.add(group);
    }
  }
  leave(scene: Scene): void {
    for (const controller of this.all) {
      this.let(controller);
      scene.remove(controller.group);
    }
    this.first = 0;
  }
  dispose(): void {
    for (const { ray } of this.all) {
      ray.geometry.dispose();
      ray.material.dispose();
    }
  }

  /** Moves the probes; the result: what carried the scene since the last frame, and where it is now. */
  frame(now: number): { from: Pose[]; now: Pose[] } | null {
    this.all.forEach((controller, k) => this.point(controller, k, now));
    const hands = this.all.filter(({ carries, isTracked }) => carries && isTracked).map(({ pose }) => pose);
    const from = this.carrying;
    this.carrying = hands;
    // A hand that came or went begins anew.
    return hands.length > 0 && hands.length === from.length ? { from, now: hands } : null;
  }

  /** Of the hands that move probes. */
  get pads(): Gamepad[] {
    const moving = this.all.filter(({ presses }, k) => presses || k === this.first);
    return moving.flatMap(({ source }) => source?.gamepad ?? []);
  }

  private point(controller: Controller, k: number, now: number): void {
    if (!controller.isTracked) return;
    const pointed = this.pointedBy(controller);
    controller.ray.scale.z = pointed?.distance ?? farRay;
    if (pointed === null || controller.carries || !(controller.presses || k === this.first)) return;
    if (controller.rest.moves(pointed, this.target.size(), now) || controller.presses) this.target.aim(controller.pointer, pointed);
  }

  private pointedBy({ pose: { place, turned } }: Controller): Pointed | null {
    return this.target.pointed(place, new Vector3(0, 0, -1).applyQuaternion(turned));
  }

  private bound(controller: Controller, k: number): Controller {
    const { group } = controller;
    group.addEventListener('connected', ({ data }) => {
      controller.source = data;
      if (data.handedness === 'right') this.first = k;
    });
    group.addEventListener('disconnected', () => {
      this.let(controller);
      controller.source = null;
    });
    group.addEventListener('selectstart', () => {
      this.first = k;
      const pointed = this.pointedBy(controller);
      // Beside the scene it carries, since hands without controllers have a trigger only.
      controller.presses = pointed !== null;
      controller.carries = pointed === null;
      if (pointed !== null) this.target.press(controller.pointer, pointed);
    });
    group.addEventListener('selectend', () => this.let(controller));
    group.addEventListener('squeezestart', () => {
      this.let(controller);
      controller.carries = true;
    });
    group.addEventListener('squeezeend', () => this.let(controller));
    return controller;
  }

  private let(controller: Controller): void {
    if (controller.presses) this.target.release(controller.pointer);
    controller.presses = controller.carries = false;
  }
}

/** A ray of the room in the scene's frame. */
export function inScene(origin: Vector3, direction: Vector3, toRoom: Matrix4): { origin: Vector3; direction: Vector3 } {
  const toScene = toRoom.clone().invert();
  return { origin: origin.clone().applyMatrix4(toScene), direction: direction.clone().transformDirection(toScene) };
}
