// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The page of a touch: wires the socket, the stage, the settings, the keys, what is heard and what is said.
import { Importance } from './announcer';
import type { HeightsFrame, PictureFrame } from './codec';
import { Connection } from './connection';
import { Controls, element, type Settings } from './controls';
import { motionWords, positionWords, sceneWords } from './describe';
import { Feedback } from './feedback';
import { protocolVersion, type Hello, type Law, type Scene, type Settings as Told, type State, type ToPage } from './generated/protocol';
import { History } from './history';
import { keyRows, press, type KeyTarget, type Move } from './keys';
import { ForcePlot } from './plot';
import { defaults, preferencesCookie, readPreferences } from './preferences';
import { ProbeHand } from './probe';
import { Stage } from './stage';
import { Surface } from './surface';
import { Voice } from './voice';

const initial: Settings = {
  touch: { law: '', stiffness: 0, damping_Ns_per_m: 0, friction: 0, exaggeration: 1 },
  page: readPreferences(document.cookie),
};
/** How long the page waits for the answer to a change before it believes what it is told (ms). */
const answerTime = 3000;
const names: Record<string, string> = { exaggeration: 'depth', surface: 'surface', law: 'force law' };

class Page implements KeyTarget {
  private readonly history = new History<Settings>(initial);
  private readonly stage = new Stage(initial.page);
  private readonly controls = new Controls(initial, (settings, what) => this.change(settings, what));
  private readonly voice = new Voice();
  private readonly feedback = new Feedback();
  private readonly plot = new ForcePlot(element<HTMLCanvasElement>('plot'));
  private readonly hand = new ProbeHand();
  private readonly connection = new Connection({
    opened: () => this.opened(),
    message: (message) => this.receive(message),
    raster: (frame) => this.receiveRaster(frame),
    closed: (sentence, final) => this.closed(sentence, final),
  });
  private hello: Hello | null = null;
  private laws: Law[] = [];
  private scene: Scene | null = null;
  private surface: Surface | null = null;
  private picture: PictureFrame | null = null;
  private state: State | null = null;
  private begun: Settings['touch'] | null = null;
  private paused = false;
  private faulty = false;
  private serial = Math.floor(Math.random() * 2 ** 31);
  private askedAt = -Infinity;
  private moved = false;
  private lastFrame = performance.now();
  private frames = 0;
  private framesSince = performance.now();

  start(): void {
    this.bindStage();
    this.bindButtons();
    this.apply();
    document.addEventListener('visibilitychange', () => this.connection.send({ type: 'visible', visible: !document.hidden }));
    for (const query of ['(prefers-color-scheme: dark)', '(prefers-contrast: more)'])
      matchMedia(query).addEventListener('change', () => this.apply());
    void this.connection.run();
    requestAnimationFrame((now) => this.frame(now));
  }

  // What the keys do.

  move(by: Move): void {
    if (this.surface === null || !this.handMoves()) return;
    const free = this.hand.step(by.x, by.y, by.press, this.surface);
    this.moved = true;
    const { surface } = this;
    this.voice.say(() => {
      if (by.press !== 0) return this.pressWords();
      const scale = this.history.now.touch.exaggeration;
      const slope = surface.slopeAt(this.hand.place);
      const words = motionWords(surface.heightAt(this.hand.place) * scale, { x: slope.x * scale, y: slope.y * scale }, this.label());
      return free ? words : `Rim of the scene, ${words}`;
    }, Importance.motion);
  }
  describe(): void {
    if (this.surface === null || this.scene === null) return this.voice.say('There is no scene yet.', Importance.answer);
    this.voice.say(sceneWords(this.surface, this.scene.name, this.history.now.touch.exaggeration, this.probePlace()), Importance.answer);
  }
  where(): void {
    const { surface } = this;
    if (surface === null) return this.voice.say('There is no scene yet.', Importance.answer);
    const scale = this.history.now.touch.exaggeration;
    const place = this.probePlace();
    const slope = surface.slopeAt(place);
    this.voice.say(
      positionWords(place, surface.heightAt(place) * scale, { x: slope.x * scale, y: slope.y * scale }, this.label(), surface),
      Importance.answer,
    );
  }
  recentre(): void {
    this.hand.recentre();
    this.moved = true;
    this.connection.send({ type: 'recentre' });
    this.voice.say('In the middle.', Importance.answer);
  }
  pause(): void {
    this.connection.send({ type: 'pause', paused: !this.paused });
  }
  mute(): void {
    const { now } = this.history;
    const sound = !now.page.sound;
    this.change({ ...now, page: { ...now.page, sound } }, 'sound');
    this.voice.say(sound ? 'Sound on.' : 'Sound off.', Importance.answer);
  }
  help(): void {
    element<HTMLDialogElement>('help-dialog').showModal();
  }

  // Settings.

  private change(settings: Settings, what: string): void {
    this.history.change(settings, what, performance.now());
    this.apply();
  }

  private apply(): void {
    const settings = this.history.now;
    this.controls.show(settings);
    this.stage.set(settings.touch.exaggeration, settings.page);
    this.voice.set(settings.page.speech);
    this.feedback.set(settings.page);
    element<HTMLButtonElement>('undo').disabled = !this.history.canUndo;
    element<HTMLButtonElement>('redo').disabled = !this.history.canRedo;
    const cookie = preferencesCookie(settings.page);
    if (this.history.canUndo || this.history.canRedo) document.cookie = cookie;
    this.showProbe();
    if (settings.touch.law === '' || this.begun === null || sameTouch(settings.touch, this.asked ?? this.begun)) return;
    this.asked = settings.touch;
    this.serial = (this.serial + 1) % 2 ** 32;
    this.askedAt = performance.now();
    this.connection.send({ type: 'change', serial: this.serial, ...settings.touch });
  }
  private asked: Settings['touch'] | null = null;

  private undoOrRedo(which: 'undo' | 'redo'): void {
    const before = this.history.now;
    if (!this.history[which]()) return this.voice.say(`Nothing to ${which}.`, Importance.answer);
    this.apply();
    this.voice.say(`${which === 'undo' ? 'Taken back' : 'Made again'}: ${difference(before, this.history.now)}.`, Importance.answer);
  }

  private told({ answers, paused, type: _, ...touch }: Told): void {
    if (paused !== this.paused) this.voice.say(paused ? 'Paused: no force.' : 'Going on.', Importance.news);
    this.paused = paused;
    element('pause').setAttribute('aria-pressed', String(paused));
    element('pause').textContent = paused ? 'Go on' : 'Pause';
    this.stage.element.toggleAttribute('data-paused', paused);
    this.showStatus();
    // While a slider is dragged the answers to its earlier places come in: only the last one counts.
    if (this.asked !== null && answers !== this.serial && performance.now() - this.askedAt < answerTime) return;
    this.asked = touch;
    const settings = { ...this.history.now, touch };
    if (this.begun === null) {
      this.begun = touch;
      this.history.restart(settings);
    } else {
      this.history.correct(settings);
    }
    this.apply();
  }

  // The program.

  private opened(): void {
    this.laws = [];
    this.asked = null;
    element('banner').hidden = true;
    this.connection.send({ type: 'visible', visible: !document.hidden });
    this.moved = true;
  }

  private closed(sentence: string, final: boolean): void {
    this.state = null;
    this.faulty = true;
    this.alert(sentence);
    element('status').textContent = final ? 'Ended' : 'Not connected';
    element('status').dataset.state = 'fault';
  }

  private receive(message: ToPage): void {
    switch (message.type) {
      case 'hello':
        return this.greeted(message);
      case 'law':
        this.laws = [...this.laws, message];
        return this.controls.setLaws(this.laws);
      case 'scene':
        this.scene = message;
        element('scene-name').textContent = message.name;
        document.title = `${message.name} – Palpable`;
        return;
      case 'settings':
        return this.told(message);
      case 'state':
        return this.ticked(message);
      case 'notice':
        if (message.level === 'fault') return this.alert(message.text);
        if (message.level === 'recovered') element('banner').hidden = true;
        return this.voice.say(message.text, Importance.news);
    }
  }

  private greeted(hello: Hello): void {
    this.hello = hello;
    this.faulty = hello.version !== protocolVersion;
    if (this.faulty) this.alert('This page and the program are of different versions: reload the page.');
    this.showStatus();
  }

  private receiveRaster(frame: HeightsFrame | PictureFrame): void {
    if (this.scene === null || frame.scene !== this.scene.scene) return;
    if (frame.kind === 'heights') {
      const again = this.surface !== null;
      const { width_m, depth_m, name } = this.scene;
      this.surface = new Surface(frame.columns, frame.rows, frame.heights, width_m, depth_m);
      this.picture = null;
      this.stage.element.setAttribute('aria-label', `Relief of ${name} to touch`);
      if (!again) this.voice.say(`${name} is ready to be touched. D describes it, H is help.`, Importance.news);
    } else {
      this.picture = frame;
    }
    if (this.surface === null || (this.scene.has_picture && this.picture === null)) return;
    this.stage.show(this.surface, this.picture);
    this.showProbe();
  }

  private ticked(state: State): void {
    this.state = state;
    const force = Math.hypot(state.fx_N, state.fy_N, state.fz_N);
    this.plot.add(state.t_s, force);
    if (this.surface) {
      this.feedback.state(state, this.surface);
      if (!this.handMoves()) this.feedback.moved({ x: state.x_m, y: state.y_m }, this.surface, this.history.now.touch.exaggeration);
    }
    this.showProbe();
    const millimetres = (metres: number) => (metres * 1000).toFixed(1);
    element('read-position').textContent = `${millimetres(state.x_m)}, ${millimetres(state.y_m)} mm`;
    element('read-height').textContent = `${millimetres(state.surface_m)} mm`;
    element('read-force').textContent = `${force.toFixed(2)} N`;
  }

  // The probe and the picture.

  private handMoves(): boolean {
    return this.hello?.pointer_moves ?? true;
  }

  private probePlace(): { x: number; y: number } {
    return this.handMoves() || this.state === null ? this.hand.place : { x: this.state.x_m, y: this.state.y_m };
  }

  private label(): string {
    return (this.state && this.scene?.labels[this.state.label]) ?? '';
  }

  private pressWords(): string {
    const depth = Math.abs(this.hand.press * 1000).toFixed(1);
    return this.hand.press >= 0 ? `Pressed ${depth} millimetres deep` : `Lifted by ${depth} millimetres`;
  }

  private showProbe(): void {
    if (this.surface === null) return;
    const place = this.probePlace();
    const lifted = Math.max(0, -this.hand.press);
    const { state } = this;
    const z = this.handMoves()
      ? this.surface.heightAt(place) * this.history.now.touch.exaggeration + lifted
      : Math.max(state?.z_m ?? 0, state?.surface_m ?? 0);
    this.stage.probe({
      ...place,
      z,
      force: [state?.fx_N ?? 0, state?.fy_N ?? 0, state?.fz_N ?? 0],
      contact: state?.contact ?? false,
    });
  }

  private frame(now: number): void {
    requestAnimationFrame((next) => this.frame(next));
    const seconds = Math.min(0.1, (now - this.lastFrame) / 1000);
    this.lastFrame = now;
    if (this.surface && this.handMoves()) {
      const { exaggeration } = this.history.now.touch;
      if (this.hand.advance(seconds, this.surface, exaggeration) || this.moved) {
        const { x, y } = this.hand.place;
        this.connection.send({ type: 'pointer', x_m: x, y_m: y, press_m: this.hand.press });
        this.feedback.moved(this.hand.place, this.surface, exaggeration);
        this.moved = false;
        this.showProbe();
      }
    }
    this.voice.tick();
    this.stage.draw();
    this.tellRates(now);
  }

  /** Once a second where motion is unwelcome, else every frame: the plot creeps. */
  private tellRates(now: number): void {
    this.frames += 1;
    const calm = matchMedia('(prefers-reduced-motion: reduce)').matches;
    const second = now - this.framesSince >= 1000;
    if (this.state && (!calm || second)) this.plot.draw();
    if (!second) return;
    const rate = Math.round((this.frames * 1000) / (now - this.framesSince));
    const device = this.hello ? ` · ${this.hello.device}` : '';
    element('rates').textContent = `${rate} pictures a second · force ${Math.round(this.state?.rate_hz ?? 0)} times a second${device}`;
    element('rates').dataset.frames = String(rate);
    if (this.state)
      element('plot-words').textContent = `Greatest in the last ten seconds: ${this.plot.greatest().toFixed(2)} N.`;
    this.frames = 0;
    this.framesSince = now;
  }

  private showStatus(): void {
    if (this.faulty) return;
    element('status').textContent = this.paused ? 'Paused' : 'Touching';
    element('status').dataset.state = this.paused ? 'paused' : 'running';
  }

  private alert(sentence: string): void {
    const banner = element('banner');
    banner.textContent = sentence;
    banner.hidden = false;
    if (this.history.now.page.speech) this.voice.say(sentence, Importance.fault);
  }

  private bindStage(): void {
    const { element: stage } = this.stage;
    const aim = (event: PointerEvent) => {
      if (this.surface === null || !this.handMoves()) return;
      const box = stage.getBoundingClientRect();
      const place = this.stage.placeAt(event.clientX - box.left - stage.clientLeft, event.clientY - box.top - stage.clientTop);
      if (place) this.hand.aim(place, this.surface);
      if (event.pointerType === 'pen' && event.pressure > 0) this.hand.penPressure(event.pressure);
    };
    stage.addEventListener('pointermove', aim);
    stage.addEventListener('pointerdown', (event) => {
      this.feedback.sound.wake();
      stage.setPointerCapture(event.pointerId);
      aim(event);
    });
    stage.addEventListener('keydown', (event) => {
      this.feedback.sound.wake();
      if (press(event, this)) event.preventDefault();
    });
  }

  private bindButtons(): void {
    const onClick = (id: string, act: () => void) =>
      element(id).addEventListener('click', () => {
        this.feedback.sound.wake();
        act();
      });
    onClick('pause', () => this.pause());
    onClick('recentre', () => this.recentre());
    onClick('describe', () => this.describe());
    onClick('where', () => this.where());
    onClick('help', () => this.help());
    onClick('undo', () => this.undoOrRedo('undo'));
    onClick('redo', () => this.undoOrRedo('redo'));
    onClick('reset', () => {
      const touch = this.begun ?? this.history.now.touch;
      this.change({ touch, page: { ...defaults } }, 'reset');
      this.voice.say('All settings are as at the start.', Importance.answer);
    });
    document.addEventListener('keydown', (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
      const key = event.key.toLowerCase();
      if (key !== 'z' && key !== 'y') return;
      event.preventDefault();
      this.undoOrRedo(key === 'y' || event.shiftKey ? 'redo' : 'undo');
    });
    element('help-keys').replaceChildren(
      ...keyRows.map(({ shown, does }) => {
        const row = document.createElement('tr');
        const head = document.createElement('th');
        head.scope = 'row';
        head.textContent = shown;
        row.append(head);
        row.insertCell().textContent = does;
        return row;
      }),
    );
  }
}

function sameTouch(a: Settings['touch'], b: Settings['touch']): boolean {
  return Object.keys(a).every((key) => a[key as keyof typeof a] === b[key as keyof typeof b]);
}

/** Which settings differ, in words. */
function difference(a: Settings, b: Settings): string {
  const keys = [
    ...Object.keys(a.touch).filter((key) => a.touch[key as keyof Settings['touch']] !== b.touch[key as keyof Settings['touch']]),
    ...Object.keys(a.page).filter((key) => a.page[key as keyof Settings['page']] !== b.page[key as keyof Settings['page']]),
  ];
  return keys.map((key) => names[key] ?? key.replace(/_.*/, '')).join(', ');
}

new Page().start();
