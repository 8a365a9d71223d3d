// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The stage with the view: 3D if the browser supports it, flat otherwise or if preferred.
import { t } from '../language';
import type { PictureFrame } from '../codec';
import { element } from '../dom';
import { defaults, type Preferences } from '../settings/preferences';
import { themeOf } from '../settings/theme';
import type { Place, Surface } from '../surface';
import { Camera, cameraTilt, shiftWords, turnWords } from './camera';
import type { Fit } from './depth/fit';
import type { ScreenPoint } from './depth/frustum';
import { clampHead, headStep, headWords, restingHead } from './depth/head';
import type { Registration } from './depth/registration';
import { bindGestures } from './gestures';
import type { Headset } from './headset/headset';
import type { SecondView } from './second_view';
import type { ProbeView, View } from './view';
import { View3d } from './view3d';
import { FlatView } from './view_flat';

export interface StageTarget {
  /** The view has changed: draw() must be called. */
  changed(): void;
  /** A drag has tilted the scene (degrees). */
  tilted(tilt: number): void;
  /** The user accepts the flat view that is offered on a slow machine. */
  flattened(): void;
  say(words: string): void;
  /** The answer to a key. */
  answer(words: string): void;
}

/** Degrees per pixel of a drag, and per press of an arrow key. */
const dragRate = 0.4;
const keyTurn = 10;
/** Metres per pixel of a drag that moves the head. */
const headRate = 0.001;
const tilts = { least: 0, most: 80 };

/** What drags, pinches and arrow keys move. */
export type Moves = 'probe' | 'picture' | 'head';

export class Stage {
  readonly element = element<HTMLDivElement>('stage');
  private readonly camera = new Camera();
  private view: View | null = null;
  private kind: Preferences['view'] | null = null;
  private surface: Surface | null = null;
  private picture: PictureFrame | null = null;
  private cells: PictureFrame | null = null;
  private second: SecondView | null = null;
  private heightFactor = 1;
  private canDo3d = true;
  private offered = false;
  private moves: Moves = 'probe';
  private headMoved = restingHead;
  private registration: Registration | null = null;

  constructor(
    private look: Preferences,
    private readonly target: StageTarget,
  ) {
    new ResizeObserver(() => {
      this.view?.resize();
      this.target.changed();
    }).observe(this.element);
    bindGestures(this.element, {
      isMoving: () => this.moves !== 'probe',
      turn: (right, down) => this.dragged(right, down),
      pan: (right, down) => this.pan(right, down),
      zoom: (factor, left, top) => this.zoom(factor, this.placeAt(left, top)),
    });
    element('view-flat').addEventListener('click', () => {
      this.note(null);
      this.target.flattened();
    });
    this.set(1, look);
  }

  show(surface: Surface, picture: PictureFrame | null, cells: PictureFrame | null, second: SecondView | null): void {
    this.surface = surface;
    this.picture = picture;
    this.cells = cells;
    this.second = second;
    this.lay();
    this.target.changed();
  }

  set(heightFactor: number, look: Preferences): void {
    this.heightFactor = heightFactor;
    const covered = (look.surface === 'cells') !== (this.look.surface === 'cells');
    this.look = look;
    if (covered) this.lay();
    const wanted = this.canDo3d ? look.view : 'flat';
    document.documentElement.dataset.theme = themeOf(look.theme);
    if (wanted !== this.kind) this.build(wanted);
    this.view?.set(heightFactor, look);
    this.moveHead(this.headMoved);
  }

  probes(probes: readonly ProbeView[]): void {
    if (this.view?.probes(probes)) this.target.changed();
  }
  line(points: readonly Place[]): void {
    this.view?.line(points);
    this.target.changed();
  }
  /** Whether a view for two eyes shows the pair's own second picture to the right one. */
  get showsSecond(): boolean {
    return this.second !== null && this.look.secondView && (this.look.surface === 'picture' || this.look.surface === 'unlit');
  }
  /** What is drawn on; null before that. */
  get canvas(): HTMLCanvasElement | null {
    return this.view?.canvas ?? null;
  }
  placeAt(left: number, top: number): Place | null {
    return this.view?.placeAt(left, top) ?? null;
  }
  /** `waited`: milliseconds from the request of this frame to its beginning. */
  draw(waited: number): void {
    if (this.view?.draw(waited) !== 'too slow' || this.offered) return;
    this.offered = true;
    this.note(t('Drawing in 3D is slow on this machine.'), true);
    this.target.say(t('Drawing in 3D is slow on this machine. The view from above is offered under the picture.'));
  }

  // The camera.

  get magnification(): number {
    return this.camera.pose.zoom;
  }
  get moving(): Moves {
    return this.moves;
  }
  setMoving(moves: Moves): void {
    this.moves = moves;
    this.element.toggleAttribute('data-moving-view', moves !== 'probe');
  }
  resetView(): void {
    this.camera.reset();
    this.moveHead(restingHead);
    this.headset?.again();
    if (this.kind === '3d' && this.look.tilt !== defaults.tilt) this.target.tilted(defaults.tilt);
    this.aim();
  }
  zoom(factor: number, about: Place | null = null): void {
    if (this.surface) this.camera.zoomBy(factor, about, this.surface);
    this.aim();
  }
  /** Handles keys that move the picture or the head, and says the new view; false for other keys. */
  moveViewBy({ key, shiftKey, ctrlKey, altKey, metaKey }: KeyboardEvent): boolean {
    if (this.moves === 'probe' || ctrlKey || altKey || metaKey) return false;
    const arrows: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const way = arrows[key];
    if (way === undefined) return false;
    const [right, down] = way;
    if (this.moves === 'head') {
      this.moveHeadBy(headStep(right, down, shiftKey));
      this.target.answer(headWords(this.headMoved));
      return true;
    }
    const tenth = Math.min(this.element.clientWidth, this.element.clientHeight) / 10;
    if (shiftKey) {
      this.pan(right * tenth, down * tenth);
      this.target.answer(shiftWords(this.camera.pose));
    } else {
      this.turn(-right * keyTurn, -down * keyTurn);
      this.target.answer(this.kind === 'flat' ? t('Seen from above the picture does not turn. Arrows with Shift shift it.') : turnWords(this.camera.pose, this.look.tilt));
    }
    return true;
  }

  // True depth on the screen.

  /** How the scene is shown on the screen in a depth mode; null: as a usual picture. */
  get fit(): Fit | null {
    return this.view?.fit ?? null;
  }
  /** Sets how far the head has moved from its resting place (depth/head.ts). */
  moveHead(moved: ScreenPoint): void {
    this.headMoved = clampHead(moved, this.look.screenDistance / 1000);
    this.view?.head(this.headMoved);
    this.target.changed();
  }
  /** Shows the scene in the depth modes where the hand feels it; null: in the middle of the picture. */
  register(registration: Registration | null): void {
    this.registration = registration;
    this.placeAgain();
  }
  /** The stage is at another place on the screen. */
  placeAgain(): void {
    this.view?.register(this.registration);
    this.target.changed();
  }
  /** Null: the view cannot be shown in one. */
  get headset(): Headset | null {
    return this.view?.headset ?? null;
  }

  private moveHeadBy({ x, y, z }: ScreenPoint): void {
    const { headMoved } = this;
    this.moveHead({ x: headMoved.x + x, y: headMoved.y + y, z: headMoved.z + z });
  }

  private dragged(right: number, down: number): void {
    if (this.moves === 'head') this.moveHeadBy({ x: right * headRate, y: -down * headRate, z: 0 });
    else this.turn(-right * dragRate, -down * dragRate);
  }
  private turn(degrees: number, tilt: number): void {
    if (this.kind === 'flat') return;
    this.camera.turnBy(degrees);
    const more = this.surface ? cameraTilt(tilt, this.surface) : tilt;
    const tilted = Math.min(tilts.most, Math.max(tilts.least, this.look.tilt + more));
    if (tilted !== this.look.tilt) this.target.tilted(tilted);
    this.aim();
  }
  private pan(right: number, down: number): void {
    if (this.surface === null || this.view === null) return;
    const metres = this.view.metresPerPixel();
    this.camera.panBy(right * metres, -down * metres, this.surface);
    this.aim();
  }
  private aim(): void {
    this.view?.aim(this.camera.pose);
    this.target.changed();
  }

  /** Shows the surface with the picture or its cells. */
  private lay(): void {
    const cells = this.look.surface === 'cells' ? this.cells : null;
    if (this.surface) this.view?.show(this.surface, cells ?? this.picture, cells === null ? this.second : null);
  }

  private build(wanted: Preferences['view']): void {
    this.view?.dispose();
    this.kind = wanted;
    if (wanted === '3d') {
      try {
        this.view = new View3d(this.element);
        this.view.canvas.addEventListener('webglcontextlost', () => this.giveUp3d(t('The 3D view was lost (no WebGL).')));
      } catch {
        return this.giveUp3d(t('This browser cannot show the surface in 3D (no WebGL).'));
      }
    } else {
      this.view = new FlatView();
      this.element.append(this.view.canvas);
    }
    this.lay();
    this.view.resize();
    this.view.set(this.heightFactor, this.look);
    this.view.aim(this.camera.pose);
    this.view.head(this.headMoved);
    this.view.register(this.registration);
  }

  private giveUp3d(why: string): void {
    this.canDo3d = false;
    this.note(`${why} ${t('It is shown from above instead. Touch, sound and speech work as usual.')}`);
    const choice = element<HTMLSelectElement>('view');
    choice.disabled = true;
    this.build('flat');
  }

  /** A sentence under the picture, or none; with a button for the flat view. */
  private note(words: string | null, offer = false): void {
    element('view-note').hidden = words === null;
    element('view-note-words').textContent = words ?? '';
    element('view-flat').hidden = !offer;
  }
}
