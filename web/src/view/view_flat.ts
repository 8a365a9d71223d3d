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
/** A probe's circle with its border, and half of its arrow's width, stay within this of their middle (CSS pixels). */
const probeReach = 14;

/** A part of the canvas, device pixels. */
interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

/** Where the scene lies on the canvas, CSS pixels. */
interface Frame {
  middleX: number;
  middleY: number;
  scale: number;
}

type Colours = ReturnType<typeof themeColours>;

export class FlatView implements View {
  readonly headset = null;
  readonly canvas = document.createElement('canvas');
  readonly fit = null;
  private surface: Surface | null = null;
  private picture: PictureFrame | null = null;
  private heightFactor = 1;
  private look: Preferences['surface'] = 'picture';
  /** The shaded surface, a pixel for each sample. */
  private ground: HTMLCanvasElement | null = null;
  /** All but the probes, a pixel for each of the canvas; null: it must be drawn. */
  private backdrop: HTMLCanvasElement | null = null;
  /** Where the canvas shows probes. */
  private covered: Box[] = [];
  private colours: Colours | null = null;
  /** Of the canvas, CSS pixels: asking the browser for it costs a layout. */
  private size = { width: 0, height: 0 };
  private drawn: readonly Place[] = [];
  private here: readonly ProbeView[] = [];
  private pose: CameraPose = frontPose;
  private stale = true;

  show(surface: Surface, picture: PictureFrame | null): void {
    this.surface = surface;
    this.picture = picture;
    this.ground = null;
    this.renew();
  }

  set(heightFactor: number, look: Look): void {
    this.heightFactor = heightFactor;
    this.look = look.surface;
    this.ground = null;
    this.colours = null;
    this.renew();
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
    this.renew();
  }

  metresPerPixel(): number {
    return 1 / (this.frame()?.scale ?? 1);
  }

  line(points: readonly Place[]): void {
    this.drawn = points;
    this.renew();
  }

  placeAt(left: number, top: number): Place | null {
    const frame = this.frame();
    if (frame === null) return null;
    return { x: (left - frame.middleX) / frame.scale, y: (frame.middleY - top) / frame.scale };
  }

  resize(): void {
    const ratio = window.devicePixelRatio;
    this.size = { width: this.canvas.clientWidth, height: this.canvas.clientHeight };
    this.canvas.width = Math.max(1, Math.round(this.size.width * ratio));
    this.canvas.height = Math.max(1, Math.round(this.size.height * ratio));
    this.renew();
  }

  draw(): Speed {
    const pen = this.canvas.getContext('2d');
    const frame = this.frame();
    if (!this.stale || pen === null || frame === null || this.surface === null) return 'fine';
    this.stale = false;
    const colours = (this.colours ??= themeColours(this.canvas));
    const ratio = window.devicePixelRatio;
    if (this.backdrop === null) this.covered = [{ left: 0, top: 0, width: this.canvas.width, height: this.canvas.height }];
    this.backdrop ??= this.withoutProbes(this.surface, frame, colours);
    // Only what the probes covered is drawn anew: a whole canvas costs a slow processor most of a frame.
    pen.setTransform(1, 0, 0, 1, 0, 0);
    for (const { left, top, width, height } of this.covered) {
      pen.clearRect(left, top, width, height);
      pen.drawImage(this.backdrop, left, top, width, height, left, top, width, height);
    }
    this.covered = this.here.map((probe) => this.boxOf(probe, frame)).filter(({ width, height }) => width > 0 && height > 0);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    for (const probe of this.here) this.drawProbe(pen, probe, frame, colours);
    return 'fine';
  }

  dispose(): void {
    this.canvas.remove();
  }

  /** All but the probes must be drawn again. */
  private renew(): void {
    this.backdrop = null;
    this.stale = true;
  }

  private frame(): Frame | null {
    if (this.surface === null) return null;
    const { width, height } = this.size;
    const margin = 12;
    const { zoom, centre } = this.pose;
    const scale = zoom * Math.min((width - 2 * margin) / this.surface.sizeX, (height - 2 * margin) / this.surface.sizeY);
    return { middleX: width / 2 - centre.x * scale, middleY: height / 2 + centre.y * scale, scale };
  }

  private withoutProbes(surface: Surface, frame: Frame, colours: Colours): HTMLCanvasElement {
    const backdrop = document.createElement('canvas');
    backdrop.width = this.canvas.width;
    backdrop.height = this.canvas.height;
    const pen = backdrop.getContext('2d')!;
    const ratio = window.devicePixelRatio;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.ground ??= this.shaded(surface, colours.clay);
    const [width, height] = [surface.sizeX * frame.scale, surface.sizeY * frame.scale];
    pen.imageSmoothingQuality = 'high';
    pen.drawImage(this.ground, frame.middleX - width / 2, frame.middleY - height / 2, width, height);
    pen.beginPath();
    this.drawn.forEach(({ x, y }, k) => pen[k === 0 ? 'moveTo' : 'lineTo'](frame.middleX + x * frame.scale, frame.middleY - y * frame.scale));
    pen.lineWidth = 3;
    pen.strokeStyle = colours.force;
    pen.stroke();
    return backdrop;
  }

  /** What a probe with its arrow covers of the canvas. */
  private boxOf(probe: ProbeView, frame: Frame): Box {
    const ratio = window.devicePixelRatio;
    const [x, y] = [frame.middleX + probe.x * frame.scale, frame.middleY - probe.y * frame.scale];
    const [toX, toY] = [x + probe.force[0] * newtonPixels, y - probe.force[1] * newtonPixels];
    const within = (pixels: number, most: number) => Math.min(most, Math.max(0, pixels));
    const left = within(Math.floor((Math.min(x, toX) - probeReach) * ratio), this.canvas.width);
    const top = within(Math.floor((Math.min(y, toY) - probeReach) * ratio), this.canvas.height);
    const right = within(Math.ceil((Math.max(x, toX) + probeReach) * ratio), this.canvas.width);
    const bottom = within(Math.ceil((Math.max(y, toY) + probeReach) * ratio), this.canvas.height);
    return { left, top, width: right - left, height: bottom - top };
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
    frame: Frame,
    colours: Colours,
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
