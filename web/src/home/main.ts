// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The page of a touch: wires the socket, the stage, the settings, the keys, what is heard and what is said.
import { Importance } from '../sound/announcer';
import type { HeightsFrame, PictureFrame } from '../codec';
import { Connection } from './connection';
import { element } from '../dom';
import { Controls, type Settings } from '../settings/controls';
import { motionWords, noScene, positionWords, sceneWords } from '../sound/describe';
import { pace, turnBy } from '../probe/explorer';
import { Feedback } from '../sound/feedback';
import type { Felt } from '../felt';
import { protocolVersion, type Hello, type Law, type Scene, type Settings as ProgramSettings, type State, type ToPage } from '../generated/protocol';
import { fillHelp, showHelp } from './help';
import { press, undoKey, type KeyTarget, type Move } from './keys';
import { MaterialPanel } from '../settings/material_panel';
import { bindPointers } from '../probe/pointers';
import { preferencesCookie, readPreferences } from '../settings/preferences';
import { ProbeActions } from '../probe/probe_actions';
import { Probes } from '../probe/probes';
import { Readouts } from './readouts';
import { SettingsStore } from '../settings/settings_store';
import { Stage } from '../view/stage';
import { Surface, type Place } from '../surface';
import { TracePanel } from '../trace/trace_panel';
import { Voice } from '../sound/voice';
import { Walking, type Walk } from '../probe/walking';

const initial: Settings = {
  touch: { law: '', stiffness: 0, damping_Ns_per_m: 0, friction: 0, exaggeration: 1, neighbourhood_px: 3 },
  page: readPreferences(document.cookie),
  materials: [],
};
/** Milliseconds between two messages about where the probes are, at the least: many fingers on a fast screen are many messages. */
const sendEvery = 12;

class TouchPage implements KeyTarget {
  private readonly connection = new Connection({
    opened: () => this.opened(),
    message: (message) => this.receive(message),
    raster: (frame) => this.receiveRaster(frame),
    closed: (sentence, final) => this.closed(sentence, final),
  });
  private readonly store = new SettingsStore(initial, (change) => this.connection.send(change));
  private readonly stage = new Stage(initial.page);
  private readonly controls = new Controls(initial, (settings, what) => this.change(settings, what));
  private readonly materials = new MaterialPanel(initial, (settings, what) => this.change(settings, what));
  private readonly voice = new Voice();
  private readonly feedback = new Feedback();
  private readonly readouts = new Readouts();
  private readonly probes = new Probes();
  private readonly own = this.probes.own;
  private readonly actions = new ProbeActions(this.probes, {
    surface: () => this.surface,
    say: (words, importance) => this.voice.say(words, importance),
    send: (message) => this.connection.send(message),
    motionWords: () => this.motionWords(),
    labelOf: (felt) => this.labelOf(felt),
    draw: () => this.showProbes(),
  });
  private readonly walking = new Walking(this.own, {
    surface: () => this.surface,
    say: (words) => this.voice.say(words, Importance.answer),
    send: (message) => this.connection.send(message),
    stands: (stance) => this.readouts.stance(stance),
    // On contours the line is their trace.
    arrow: (points) => this.scene?.kind !== 'contours' && this.stage.line(points),
  });
  private readonly trace = new TracePanel({
    place: () => this.probePlace(),
    say: (words) => this.voice.say(words, Importance.answer),
    overlay: (points) => this.stage.line(points),
  });
  private hello: Hello | null = null;
  private laws: Law[] = [];
  private scene: Scene | null = null;
  private surface: Surface | null = null;
  private picture: PictureFrame | null = null;
  private cells: PictureFrame | null = null;
  private paused = false;
  private lastFrame = performance.now();

  start(): void {
    this.bindStage();
    this.bindButtons();
    this.bindWindow();
    fillHelp();
    this.apply();
    void this.connection.run();
    requestAnimationFrame((now) => this.frame(now));
  }

  // What the keys do.

  move(by: Move): void {
    if (this.surface === null) return;
    const { current } = this.own;
    if (!this.own.movable()) return this.voice.say(`The probe is moved by ${this.hello?.device ?? 'a device'}.`, Importance.answer);
    // The egocentric view's arrows run as the explorer faces; in the other they face up the scene.
    const way = this.walking.inScene(by);
    const free = current.step(way.x, way.y, by.press, this.surface);
    this.voice.say(() => this.probes.named(by.press !== 0 ? this.pressWords() : `${free ? '' : 'Rim of the scene, '}${this.motionWords()}`), Importance.motion);
  }
  describe(): void {
    if (this.surface === null || this.scene === null) return this.voice.say(noScene, Importance.answer);
    this.voice.say(sceneWords(this.surface, this.scene.name, this.exaggeration(), this.probePlace()), Importance.answer);
  }
  where(): void {
    if (this.surface === null) return this.voice.say(noScene, Importance.answer);
    const { height, slope } = this.ground(this.surface);
    this.voice.say(this.probes.named(positionWords(this.probePlace(), height, slope, this.label(), this.surface)), Importance.answer);
  }
  recentre(): void {
    this.own.current.recentre();
    this.walking.reset();
    if (this.own.chosen === 0) this.connection.send({ type: 'recentre' });
    this.walking.stand();
    this.voice.say(this.probes.named('In the middle.'), Importance.answer);
  }
  walk(by: Walk): void {
    this.walking.walk(by);
  }
  stance(): void {
    this.walking.sayStance();
  }
  choose(probe: number): void {
    this.actions.choose(probe);
  }
  take(): void {
    this.actions.take();
  }
  describeProbes(): void {
    this.actions.describeProbes();
  }
  pause(): void {
    this.connection.send({ type: 'pause', paused: !this.paused });
  }
  mute(): void {
    const { settings } = this.store;
    const sound = !settings.page.sound;
    this.change({ ...settings, page: { ...settings.page, sound } }, 'sound');
    this.voice.say(sound ? 'Sound on.' : 'Sound off.', Importance.answer);
  }
  help(): void {
    showHelp();
  }

  // Settings.

  private change(settings: Settings, what: string): void {
    this.store.change(settings, what);
    this.apply();
    if (what === 'surface' && settings.page.surface === 'cells' && this.scene) this.voice.say(this.scene.cells, Importance.answer);
  }

  private apply(): void {
    const { settings } = this.store;
    this.controls.show(settings);
    this.materials.show(settings, this.controls.law());
    this.stage.set(settings.touch.exaggeration, settings.page);
    this.voice.set(settings.page.speech);
    this.feedback.set(settings.page);
    element<HTMLButtonElement>('undo').disabled = !this.store.canUndo;
    element<HTMLButtonElement>('redo').disabled = !this.store.canRedo;
    if (this.store.wasUsed) document.cookie = preferencesCookie(settings.page);
    this.showProbes();
  }

  private undoOrRedo(which: 'undo' | 'redo'): void {
    const changed = this.store.undoOrRedo(which);
    if (changed === null) return this.voice.say(`Nothing to ${which}.`, Importance.answer);
    this.apply();
    this.voice.say(`${which === 'undo' ? 'Taken back' : 'Made again'}: ${changed}.`, Importance.answer);
  }

  private receiveSettings(settings: ProgramSettings): void {
    if (settings.paused !== this.paused) this.voice.say(settings.paused ? 'Paused: no force.' : 'Going on.', Importance.news);
    this.paused = settings.paused;
    element('pause').textContent = this.paused ? 'Go on' : 'Pause';
    this.stage.element.toggleAttribute('data-paused', this.paused);
    this.readouts.status(this.paused ? 'paused' : 'running', this.paused ? 'Paused' : 'Touching');
    if (this.store.receive(settings)) this.apply();
  }

  // The program.

  private opened(): void {
    this.laws = [];
    this.resendPlaces();
    this.store.connected();
    this.readouts.allWell();
    this.connection.send({ type: 'visible', visible: !document.hidden });
  }

  private closed(sentence: string, final: boolean): void {
    this.actions.blank();
    this.readouts.blank();
    this.alert(sentence);
    this.readouts.status('fault', final ? 'Ended' : 'Not connected');
  }

  private receive(message: ToPage): void {
    switch (message.type) {
      case 'hello':
        return this.greeted(message);
      case 'law':
        this.laws = [...this.laws, message];
        this.controls.setLaws(this.laws);
        return this.materials.show(this.store.settings, this.controls.law());
      case 'scene':
        this.scene = message;
        element('scene-name').textContent = message.name;
        this.trace.scene(message.kind, message.width_m, message.depth_m);
        this.controls.offerCells(message.cells !== '');
        document.title = `${message.name} – Palpable`;
        return;
      case 'settings':
        return this.receiveSettings(message);
      case 'materials':
        if (this.store.receiveMaterials(message)) this.apply();
        return;
      case 'state':
        return this.ticked(message);
      case 'notice':
        if (message.level === 'fault') return this.alert(message.text);
        if (message.level === 'recovered') this.readouts.allWell();
        return this.voice.say(message.text, message.level === 'answer' ? Importance.answer : Importance.news);
    }
  }

  private greeted(hello: Hello): void {
    this.hello = hello;
    this.readouts.setDevice(hello.device);
    this.own.set(hello.probes, hello.pointer_moves);
    this.actions.changed();
    this.walking.allow(hello.egocentric);
    // A device's middle is to be where this page has the explorer stand.
    if (hello.pointer_moves) this.walking.show();
    else this.walking.stand();
    if (hello.version !== protocolVersion) this.alert('This page and the program are of different versions: reload the page.');
  }

  private receiveRaster(frame: HeightsFrame | PictureFrame): void {
    if (this.scene === null || frame.scene !== this.scene.scene) return;
    if (frame.kind === 'heights') {
      const first = this.surface === null;
      const { width_m, depth_m, name } = this.scene;
      this.surface = new Surface(frame.columns, frame.rows, frame.heights, width_m, depth_m);
      this.picture = this.cells = null;
      this.resendPlaces();
      this.stage.element.setAttribute('aria-label', `Relief of ${name} to touch`);
      if (first) this.voice.say(`${name} is ready to be touched. D describes it, H is help.`, Importance.news);
    } else if (frame.kind === 'cells') {
      this.cells = frame;
    } else {
      this.picture = frame;
    }
    if (this.surface === null || (this.scene.has_picture && this.picture === null)) return;
    if (this.scene.cells !== '' && this.cells === null) return;
    this.stage.show(this.surface, this.picture, this.cells);
    this.walking.show();
    this.showProbes();
  }

  private ticked(state: State): void {
    this.probes.receive(state);
    const { felt, chosen } = this.probes;
    this.readouts.state(state, chosen ?? felt[0]!);
    this.actions.show();
    this.showProbes();
    const { surface } = this;
    if (surface === null) return;
    for (const one of felt) this.feedback.felt(one, surface);
    if (!this.own.movable(0)) this.feedback.moved(0, this.probes.placeOf(0), surface, this.exaggeration());
    this.feedback.keep(this.probes.numbers);
  }

  // The probes.

  private exaggeration(): number {
    return this.store.settings.touch.exaggeration;
  }
  private probePlace(): Place {
    return this.probes.placeOf(this.own.chosen);
  }
  private labelOf(felt: Felt | undefined): string {
    return (felt && this.scene?.labels[felt.label]) ?? '';
  }
  private label(): string {
    return this.labelOf(this.probes.chosen);
  }
  private ground(surface: Surface): { height: number; slope: Place } {
    const scale = this.exaggeration();
    const slope = surface.slopeAt(this.probePlace());
    return { height: surface.heightAt(this.probePlace()) * scale, slope: { x: slope.x * scale, y: slope.y * scale } };
  }
  private motionWords(): string {
    if (this.surface === null) return '';
    const { height, slope } = this.ground(this.surface);
    return motionWords(height, slope, this.label());
  }
  private pressWords(): string {
    const { press: pressed } = this.own.current;
    const depth = Math.abs(pressed * 1000).toFixed(1);
    return pressed >= 0 ? `Pressed ${depth} millimetres deep` : `Lifted by ${depth} millimetres`;
  }

  private resendPlaces(): void {
    for (const probe of this.own.numbers) this.own.at(probe)?.resend();
  }

  private showProbes(): void {
    if (this.surface) this.stage.probes(this.probes.views(this.surface, this.exaggeration()));
  }

  /** Moves the marbles on and sends their places. */
  private advance(now: number, surface: Surface): void {
    if (this.own.several && now - this.lastFrame < sendEvery) return;
    const seconds = Math.min(0.1, (now - this.lastFrame) / 1000);
    this.lastFrame = now;
    const moved = this.own.advance(seconds, surface, this.exaggeration());
    for (const probe of moved) {
      const { place, press: press_m } = this.own.at(probe)!;
      this.connection.send({ type: 'pointer', probe, x_m: place.x, y_m: place.y, press_m });
      this.feedback.moved(probe, place, surface, this.exaggeration());
    }
    if (moved.length > 0) this.showProbes();
  }

  private frame(now: number): void {
    requestAnimationFrame((next) => this.frame(next));
    if (this.surface) this.advance(now, this.surface);
    this.voice.tick();
    this.trace.frame(now);
    this.stage.draw();
    this.readouts.frame(now);
  }

  private alert(sentence: string): void {
    this.readouts.alert(sentence);
    this.voice.aloudOnly(sentence);
  }

  // What the person does.

  private bindStage(): void {
    const { element: stage } = this.stage;
    bindPointers(stage, this.own, {
      surface: () => this.surface,
      placeAt: (left, top) => this.stage.placeAt(left, top),
      wake: () => this.feedback.sound.wake(),
      came: (probe) => this.actions.came(probe),
      left: (probe) => this.actions.left(probe),
      full: () => this.actions.full(),
    });
    stage.addEventListener('keydown', (event) => {
      this.feedback.sound.wake();
      if (press(event, this)) event.preventDefault();
    });
  }

  private bindButtons(): void {
    const actions: Record<string, () => void> = {
      pause: () => this.pause(),
      recentre: () => this.recentre(),
      describe: () => this.describe(),
      where: () => this.where(),
      'walk-ahead': () => this.walk({ ahead: pace, left: 0 }),
      'walk-back': () => this.walk({ ahead: -pace, left: 0 }),
      'turn-left': () => this.walk({ ahead: 0, left: turnBy }),
      'turn-right': () => this.walk({ ahead: 0, left: -turnBy }),
      stance: () => this.stance(),
      help: () => this.help(),
      undo: () => this.undoOrRedo('undo'),
      redo: () => this.undoOrRedo('redo'),
      reset: () => this.reset(),
      'region-here': () => this.editHere(),
      save: () => this.connection.send({ type: 'save' }),
    };
    for (const [id, act] of Object.entries(actions))
      element(id).addEventListener('click', () => {
        this.feedback.sound.wake();
        act();
      });
  }

  private editHere(): void {
    const found = this.materials.choose(this.probes.chosen?.label ?? 0);
    this.voice.say(found ? `Editing ${this.materials.name()}.` : 'There is no region here.', Importance.answer);
  }

  private reset(): void {
    this.store.reset();
    this.apply();
    this.voice.say('All settings are as at the start.', Importance.answer);
  }

  private bindWindow(): void {
    document.addEventListener('visibilitychange', () => this.connection.send({ type: 'visible', visible: !document.hidden }));
    for (const query of ['(prefers-color-scheme: dark)', '(prefers-contrast: more)', '(forced-colors: active)'])
      matchMedia(query).addEventListener('change', () => this.apply());
    document.addEventListener('keydown', (event) => {
      const which = undoKey(event);
      if (which === null) return;
      event.preventDefault();
      this.undoOrRedo(which);
    });
  }
}

new TouchPage().start();
