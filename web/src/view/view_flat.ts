// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The scene from directly above, without WebGL: hill-shaded, optionally with the picture.
import type { PictureFrame } from '../codec';
import type { Preferences } from '../settings/preferences';
import { Surface, type Place } from '../surface';
import { frontPose, type CameraPose } from './camera';
import type { Speed } from './pace';
import { lookAlike, themeColours, type Look, type ProbeView, type View } from './view';

const lightFrom = { x: -0.5, y: 0.6, z: 0.62 };
const newtonPixels = 30;

export class FlatView implements View {
  readonly headset = null;
  readonly canvas = document.createElement('canvas');
  readonly fit = null;
  private surface: Surface | null = null;
  private picture: PictureFrame | null = null;
  private heightFactor = 1;
  private look: Preferences['surface'] = 'picture';
  private ground: HTMLCanvasElement | null = null;
  private drawn: readonly Place[] = [];
  private here: readonly ProbeView[] = [];
  private pose: CameraPose = frontPose;
  private stale = true;

  show(surface: Surface, picture: PictureFrame | null): void {
    this.surface = surface;
    this.picture = picture;
    this.ground = null;
    this.stale = true;
  }

  set(heightFactor: number, look: Look): void {
    this.heightFactor = heightFactor;
    this.look = look.surface;
    this.ground = null;
    this.stale = true;
  }

  head(): void {
    // Seen from above there is no depth.
  }
  register(): void {
    // Nor a place of its own on the screen.
  }

  probes(probes: readonly ProbeView[]): boolean {
    if (lookAlike(this.here, probes)) return false;
    this.here = probes;
    this.stale = true;
    return true;
  }

  aim(pose: CameraPose): void {
    this.pose = pose;
    this.stale = true;
  }

  metresPerPixel(): number {
    return 1 / (this.frame()?.scale ?? 1);
  }

  line(points: readonly Place[]): void {
    this.drawn = points;
    this.stale = true;
  }

  placeAt(left: number, top: number): Place | null {
    const frame = this.frame();
    if (frame === null) return null;
    return { x: (left - frame.middleX) / frame.scale, y: (frame.middleY - top) / frame.scale };
  }

  resize(): void {
    const ratio = window.devicePixelRatio;
    this.canvas.width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
    this.canvas.height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
    this.stale = true;
  }

  draw(): Speed {
    const pen = this.canvas.getContext('2d');
    const frame = this.frame();
    if (!this.stale || pen === null || frame === null || this.surface === null) return 'fine';
    this.stale = false;
    const ratio = window.devicePixelRatio;
    const colours = themeColours(this.canvas);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, this.canvas.clientWidth, this.canvas.clientHeight);
    this.ground ??= this.shaded(this.surface, colours.clay);
    const [width, height] = [this.surface.sizeX * frame.scale, this.surface.sizeY * frame.scale];
    pen.imageSmoothingQuality = 'high';
    pen.drawImage(this.ground, frame.middleX - width / 2, frame.middleY - height / 2, width, height);
    pen.beginPath();
    this.drawn.forEach(({ x, y }, k) => pen[k === 0 ? 'moveTo' : 'lineTo'](frame.middleX + x * frame.scale, frame.middleY - y * frame.scale));
    pen.lineWidth = 3;
    pen.strokeStyle = colours.force;
    pen.stroke();
    for (const probe of this.here) this.drawProbe(pen, probe, frame, colours);
    return 'fine';
  }

  dispose(): void {
    this.canvas.remove();
  }

  private frame(): { middleX: number; middleY: number; scale: number } | null {
    if (this.surface === null) return null;
    const { clientWidth, clientHeight } = this.canvas;
    const margin = 12;
    const { zoom, centre } = this.pose;
    const scale = zoom * Math.min((clientWidth - 2 * margin) / this.surface.sizeX, (clientHeight - 2 * margin) / this.surface.sizeY);
    return { middleX: clientWidth / 2 - centre.x * scale, middleY: clientHeight / 2 + centre.y * scale, scale };
  }

  /** One pixel per sample: the picture or plain clay, multiplied by the shading. */
  private shaded(surface: Surface, clay: string): HTMLCanvasElement {
    const canvas = document.createElement('canvas');
    canvas.width = surface.columns;
    canvas.height = surface.rows;
    const pen = canvas.getContext('2d')!;
    pen.fillStyle = clay;
    pen.fillRect(0, 0, 1, 1);
    const plain = pen.getImageData(0, 0, 1, 1).data;
    const image = pen.createImageData(surface.columns, surface.rows);
    const picture = this.look === 'clay' ? null : this.picture;
    for (let j = 0; j < surface.rows; ++j)
      for (let i = 0; i < surface.columns; ++i) {
        const light = this.look === 'unlit' && picture ? 1 : this.light(surface, i, j);
        const to = 4 * (j * surface.columns + i);
        for (let c = 0; c < 3; ++c) {
          const base = picture ? picture.rgb[3 * pixelOf(picture, surface, i, j) + c]! : plain[c]!;
          image.data[to + c] = Math.min(255, base * light);
        }
        image.data[to + 3] = 255;
      }
    pen.putImageData(image, 0, 0);
    return canvas;
  }

  private light(surface: Surface, i: number, j: number): number {
    const scale = this.heightFactor / 2;
    const dx = ((surface.at(i + 1, j) - surface.at(i - 1, j)) * scale * surface.columns) / surface.sizeX;
    const dy = ((surface.at(i, j - 1) - surface.at(i, j + 1)) * scale * surface.rows) / surface.sizeY;
    const facing = (lightFrom.z - dx * lightFrom.x - dy * lightFrom.y) / Math.hypot(1, dx, dy);
    return 0.35 + 1.05 * Math.max(0, facing);
  }

  private drawProbe(
    pen: CanvasRenderingContext2D,
    probe: ProbeView,
    frame: { middleX: number; middleY: number; scale: number },
    colours: { marble: string; force: string },
  ): void {
    const [x, y] = [frame.middleX + probe.x * frame.scale, frame.middleY - probe.y * frame.scale];
    pen.beginPath();
    pen.moveTo(x, y);
    pen.lineTo(x + probe.force[0] * newtonPixels, y - probe.force[1] * newtonPixels);
    pen.lineWidth = 4;
    pen.strokeStyle = colours.force;
    pen.stroke();
    pen.beginPath();
    pen.arc(x, y, 9, 0, 2 * Math.PI);
    pen.fillStyle = colours.marble;
    pen.fill();
    const several = this.here.length > 1;
    pen.lineWidth = several && probe.chosen ? 5 : 2.5;
    pen.strokeStyle = '#fff';
    pen.stroke();
    pen.lineWidth = 1;
    pen.strokeStyle = '#000';
    pen.stroke();
    if (!several) return;
    pen.font = `bold 12px ${getComputedStyle(this.canvas).fontFamily}`;
    pen.textAlign = 'center';
    pen.textBaseline = 'middle';
    pen.fillStyle = '#000';
    pen.fillText(String(probe.number), x, y + 0.5);
  }
}

function pixelOf(picture: PictureFrame, surface: Surface, i: number, j: number): number {
  const column = Math.min(picture.columns - 1, Math.floor(((i + 0.5) * picture.columns) / surface.columns));
  const row = Math.min(picture.rows - 1, Math.floor(((j + 0.5) * picture.rows) / surface.rows));
  return row * picture.columns + column;
}
