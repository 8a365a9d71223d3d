// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The stage that carries a view: three-dimensional where the browser can, flat where it cannot or where that is liked better.
import type { PictureFrame } from '../codec';
import { element } from '../dom';
import type { Preferences } from '../settings/preferences';
import type { Place, Surface } from '../surface';
import type { Probe, View } from './view';
import { View3d } from './view3d';
import { FlatView } from './view_flat';

export class Stage {
  readonly element = element<HTMLDivElement>('stage');
  private view: View | null = null;
  private kind: Preferences['view'] | null = null;
  private surface: Surface | null = null;
  private picture: PictureFrame | null = null;
  private cells: PictureFrame | null = null;
  private exaggeration = 1;
  private look: Preferences;
  private canDo3d = true;

  constructor(look: Preferences) {
    this.look = look;
    new ResizeObserver(() => this.view?.resize()).observe(this.element);
    this.set(1, look);
  }

  show(surface: Surface, picture: PictureFrame | null, cells: PictureFrame | null): void {
    this.surface = surface;
    this.picture = picture;
    this.cells = cells;
    this.lay();
  }

  set(exaggeration: number, look: Preferences): void {
    this.exaggeration = exaggeration;
    const covered = (look.surface === 'cells') !== (this.look.surface === 'cells');
    this.look = look;
    if (covered) this.lay();
    const wanted = this.canDo3d ? look.view : 'flat';
    if (wanted !== this.kind) this.build(wanted);
    document.documentElement.dataset.theme = themeOf(look.theme);
    this.view?.set(exaggeration, look);
  }

  probes(probes: readonly Probe[]): void {
    this.view?.probes(probes);
  }
  line(points: readonly Place[]): void {
    this.view?.line(points);
  }
  placeAt(left: number, top: number): Place | null {
    return this.view?.placeAt(left, top) ?? null;
  }
  draw(): void {
    this.view?.draw();
  }

  /** Puts the surface into the view, with the picture or its cells on it. */
  private lay(): void {
    if (this.surface) this.view?.show(this.surface, this.look.surface === 'cells' ? (this.cells ?? this.picture) : this.picture);
  }

  private build(wanted: Preferences['view']): void {
    this.view?.dispose();
    this.kind = wanted;
    if (wanted === '3d') {
      try {
        this.view = new View3d(this.element);
        this.view.canvas.addEventListener('webglcontextlost', () => this.giveUp3d('The 3D view was lost'));
      } catch {
        return this.giveUp3d('This browser cannot show the relief in 3D');
      }
    } else {
      this.view = new FlatView();
      this.element.append(this.view.canvas);
    }
    this.lay();
    this.view.resize();
    this.view.set(this.exaggeration, this.look);
  }

  private giveUp3d(why: string): void {
    this.canDo3d = false;
    const note = element('view-note');
    note.textContent = `${why} (no WebGL): it is shown from above instead. Touch, sound and words work as ever.`;
    note.hidden = false;
    element<HTMLSelectElement>('view').disabled = true;
    this.build('flat');
  }
}

function themeOf(theme: Preferences['theme']): string {
  if (theme !== 'system') return theme;
  if (matchMedia('(prefers-contrast: more)').matches) return 'contrast';
  return matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
}
