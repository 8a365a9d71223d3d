// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// One probe in 3D: a marble, its force as an arrow, and its number if there are several.
import {
  CanvasTexture,
  ConeGeometry,
  CylinderGeometry,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  SphereGeometry,
  Sprite,
  SpriteMaterial,
  SRGBColorSpace,
  Vector3,
} from 'three';
import type { ProbeView } from './view';

/** Metres of arrow per newton. */
const arrowScale = 0.008;
const arrowMost = 0.04;
/** In a scene of 0.1 m; metres. */
export const marbleRadius = 0.0022;
const badgePixels = 64;

export class Marble3d {
  readonly group = new Group();
  private readonly marble = new Mesh(new SphereGeometry(marbleRadius, 32, 16), new MeshStandardMaterial({ roughness: 0.25, depthTest: false }));
  private readonly arrow = new Group();
  private readonly arrowMaterial = new MeshBasicMaterial();
  private readonly shaft = new Mesh(new CylinderGeometry(0.0006, 0.0006, 1, 12), this.arrowMaterial);
  private readonly tip = new Mesh(new ConeGeometry(0.0018, 0.0045, 16), this.arrowMaterial);
  private readonly badge = new Sprite(new SpriteMaterial({ depthTest: false }));
  private badged = '';

  constructor() {
    this.arrow.add(this.shaft, this.tip);
    // Drawn last without depth test, so that neither the arrow seen end-on nor a hill hides the marble.
    this.marble.renderOrder = 1;
    this.badge.renderOrder = 2;
    this.badge.scale.setScalar(0.006);
    this.badge.position.set(0, 0.0065, 0);
    this.group.add(this.marble, this.arrow, this.badge);
  }

  /** `scale`: the scene's size in units of 0.1 m, which scales the marble and its arrow. */
  show(probe: ProbeView, several: boolean, scale: number): void {
    this.group.scale.setScalar(scale);
    this.group.position.set(probe.x, probe.y, probe.z + marbleRadius * scale);
    const force = new Vector3(...probe.force);
    const length = Math.min(arrowMost, force.length() * arrowScale);
    this.arrow.visible = length > 0.0015;
    if (this.arrow.visible) {
      this.arrow.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), force.normalize());
      this.shaft.scale.y = length;
      this.shaft.position.y = length / 2;
      this.tip.position.y = length;
    }
    this.badge.visible = several;
    if (several) this.number(String(probe.number), probe.chosen);
  }

  recolour(marble: string, force: string): void {
    this.marble.material.color.set(marble);
    this.arrowMaterial.color.set(force);
  }

  dispose(): void {
    for (const mesh of [this.marble, this.shaft, this.tip]) mesh.geometry.dispose();
    this.marble.material.dispose();
    this.arrowMaterial.dispose();
    this.badge.material.map?.dispose();
    this.badge.material.dispose();
  }

  /** Black on white; for the selected probe white on black with a ring. */
  private number(text: string, chosen: boolean): void {
    const badged = `${text}${chosen}`;
    if (badged === this.badged) return;
    this.badged = badged;
    const canvas = document.createElement('canvas');
    canvas.width = canvas.height = badgePixels;
    const pen = canvas.getContext('2d')!;
    const middle = badgePixels / 2;
    const [ground, ink] = chosen ? ['#000', '#fff'] : ['#fff', '#000'];
    pen.beginPath();
    pen.arc(middle, middle, middle - 4, 0, 2 * Math.PI);
    pen.fillStyle = ground;
    pen.fill();
    pen.lineWidth = chosen ? 6 : 3;
    pen.strokeStyle = ink;
    pen.stroke();
    pen.font = `bold ${badgePixels * 0.55}px sans-serif`;
    pen.textAlign = 'center';
    pen.textBaseline = 'middle';
    pen.fillStyle = ink;
    pen.fillText(text, middle, middle + 2);
    this.badge.material.map?.dispose();
    this.badge.material.map = new CanvasTexture(canvas);
    this.badge.material.map.colorSpace = SRGBColorSpace;
    this.badge.material.needsUpdate = true;
  }
}
