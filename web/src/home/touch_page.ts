// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The page: connects the program, the stage, the settings, the keys, sound and speech.
import type { HeightsFrame, PictureFrame } from '../codec';
import { element } from '../dom';
import { protocolVersion, type Hello, type Scene, type Settings as ProgramSettings, type State, type ToPage } from '../generated/protocol';
import { Names } from '../names/names';
import { pace, turnBy } from '../probe/explorer';
import { bindPointers } from '../probe/pointers';
import { ProbeActions } from '../probe/probe_actions';
import { Probes } from '../probe/probes';
import { Walking, type Walk } from '../probe/walking';
import { controlWords } from '../settings/control_words';
import type { Settings } from '../settings/settings';
import { Importance } from '../sound/announcer';
import { exampleActions } from '../sound/examples';
import { Feedback } from '../sound/feedback';
import { Voice } from '../sound/voice';
import type { Surface } from '../surface';
import { TracePanel } from '../trace/trace_panel';
import { Stage } from '../view/stage';
import { bindButtons, bindWindow } from './bindings';
import type { Loss } from '../enter';
import type { Program, Receiver } from './connection';
import { DepthPanel, type DepthTarget } from './depth_panel';
import { FrameLoop } from './frame_loop';
import type { HeadPanel } from './head_panel';
import { fillHelp, showHelp, showSteps } from './help';
import { press, type KeyTarget, type Move } from './keys';
import { Narrator } from './narrator';
import { ProbeMotion } from './probe_motion';
import { Readouts } from './readouts';
import { showHeading, showNoScene, showWayBack, stageLabel } from './scene_heading';
import { SceneFrames } from './scene_frames';
import { TouchSettings, type KeptPreferences } from './touch_settings';
import { ViewActions } from './view_actions';

const importanceOf = (level: string): Importance => ({ motion: Importance.motion, answer: Importance.answer, named: Importance.answer })[level] ?? Importance.news;

export class TouchPage implements KeyTarget {
  private readonly connection: Program;
  private readonly frames = new FrameLoop((now, passed, waited) => this.frame(now, passed, waited));
  private readonly settings: TouchSettings;
  private readonly stage: Stage;
  private readonly voice = new Voice();
  private readonly feedback = new Feedback((sentence) => this.voice.say(sentence, Importance.news));
  private readonly readouts = new Readouts();
  private readonly probes = new Probes();
  private readonly own = this.probes.own;
  private readonly loaded = new SceneFrames();
  private readonly narrator = new Narrator(this.loaded, this.probes, (message) => this.connection.send(message));
  private readonly actions = new ProbeActions(this.probes, {
    surface: () => this.surface,
    say: (words, importance) => this.voice.say(words, importance),
    send: (message) => this.connection.send(message),
    chosenWords: (what) => this.narrator.chosen(what),
    allWords: () => this.narrator.all(),
    draw: () => this.showProbes(),
  });
  private readonly walking = new Walking(this.own, {
    surface: () => this.surface,
    say: (words) => this.voice.say(words, Importance.answer),
    send: (message) => this.connection.send(message),
    showPose: (pose) => this.readouts.pose(pose),
    // On contours the line is the current trace.
    arrow: (points) => this.scene?.kind !== 'contours' && this.stage.line(points),
  });
  private readonly names = new Names(
    {
      surface: () => this.surface,
      probe: () => this.own.chosen,
      place: () => this.narrator.place(),
      way: () => this.narrator.way(),
      say: (words, importance) => this.voice.say(words, importance),
      send: (message) => this.connection.send(message),
      settingsSteps: () => this.settings.steps,
    },
    this.feedback,
  );
  private readonly trace = new TracePanel({
    place: () => this.narrator.place(),
    say: (words) => this.voice.say(words, Importance.answer),
    overlay: (points) => this.stage.line(points),
  });
  private readonly motion = new ProbeMotion(this.probes, this.narrator, this.walking, this.names.finder, this.feedback, {
    scene: () => this.scene,
    surface: () => this.surface,
    connected: () => this.connected,
    heightFactor: () => this.heightFactor(),
    device: () => this.hello?.device ?? 'a device',
    say: (words, importance) => this.voice.say(words, importance),
    send: (message) => this.connection.send(message),
    moves: () => this.frames.request(),
    draw: () => this.showProbes(),
  });
  private readonly picture: ViewActions;
  private readonly depth: DepthPanel;
  private readonly head: HeadPanel | null;
  private hello: Hello | null = null;
  private paused = false;
  /** Whether the program is connected; otherwise nothing is felt, moved or heard. */
  private connected = false;

  /** `followHead`: null for a page without the camera. */
  constructor(
    connect: (receiver: Receiver) => Program,
    preferences: KeptPreferences,
    followHead: ((stage: Stage, target: DepthTarget) => HeadPanel) | null = null,
  ) {
    this.connection = connect({
      opened: () => this.opened(),
      message: (message) => this.receive(message),
      raster: (frame) => this.receiveRaster(frame),
      closed: (loss) => this.closed(loss),
    });
    this.settings = new TouchSettings(preferences, {
      send: (message) => this.connection.send(message),
      say: (words) => this.voice.say(words, Importance.answer),
      follow: (settings) => this.follow(settings),
      changed: (settings, what) => this.sayChange(settings, what),
    });
    this.stage = new Stage(this.settings.now.page, {
      changed: () => this.frames.request(),
      tilted: (tilt) => this.settings.changePage({ tilt }, 'tilt'),
      flattened: () => this.settings.changePage({ view: 'flat' }, 'view'),
      say: (words) => this.voice.say(words, Importance.news),
      answer: (words) => this.voice.say(words, Importance.answer),
    });
    this.picture = new ViewActions(this.stage, (words) => this.voice.say(words, Importance.answer));
    const depth: DepthTarget = {
      page: () => this.settings.now.page,
      change: (page, what) => this.settings.changePage(page, what),
      say: (words) => this.voice.say(words, Importance.answer),
    };
    this.depth = new DepthPanel(this.stage, depth);
    this.head = followHead?.(this.stage, depth) ?? null;
  }

  start(): void {
    this.bindStage();
    this.bindAll();
    fillHelp();
    this.settings.apply();
    void this.connection.run();
    document.documentElement.dataset.frames = '0';
  }

  // The actions of the keys.

  move(by: Move): void {
    this.motion.move(by);
  }
  describe(): void {
    this.voice.say(this.narrator.describe(), Importance.answer);
  }
  where(): void {
    this.voice.say(this.narrator.where(), Importance.answer);
  }
  recentre(): void {
    this.motion.recentre();
  }
  toSurface(): void {
    this.motion.toSurface();
  }
  listPlaces(): void {
    this.names.open();
  }
  nameHere(): void {
    this.names.nameHere();
  }
  sayWay(): void {
    this.names.sayWay();
  }
  stopFinding(): void {
    this.names.stopFinding();
  }
  walk(by: Walk): void {
    this.walking.walk(by);
    this.frames.request();
  }
  pose(): void {
    this.walking.sayPose();
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
    this.settings.toggleSound();
  }
  help(): void {
    showHelp();
  }
  zoom(factor: number): void {
    this.picture.zoom(factor);
  }
  resetView(): void {
    this.picture.reset();
  }
  moveView(): void {
    this.picture.toggleMoving();
  }
  moveHead(): void {
    this.picture.toggleHead();
  }

  // Settings.

  private follow(settings: Settings): void {
    this.stage.set(settings.touch.heightFactor, settings.page);
    this.depth.show();
    this.head?.follow();
    this.picture.follow();
    this.voice.set(settings.page.speech);
    this.feedback.set(settings);
    this.readouts.redraw();
    this.offerSound();
    this.showProbes();
  }

  /** Changes of what is felt or shown are announced; other values only without a screen reader, which reads them itself. */
  private sayChange(settings: Settings, what: string): void {
    const cells = what === 'surface' && settings.page.surface === 'cells' ? this.scene?.cells : undefined;
    const law = what === 'law' ? this.settings.controls.law()?.title : undefined;
    if (cells) return this.voice.say(cells, Importance.answer);
    if (what === 'depth-mode') return this.depth.say();
    if (law !== undefined) return this.voice.say(`Force law: ${law}.`, Importance.answer);
    const words = controlWords(document.activeElement);
    if (words !== null) this.voice.aloudOnly(words);
  }

  /** Offered until audio runs, since browsers start it only after a user action. */
  private offerSound(): void {
    element('sound-on').hidden = this.settings.now.page.sound && this.feedback.sound.runs;
  }

  /** Starts audio from this click, with a sound at once. */
  private turnOnSound(): void {
    if (!this.settings.now.page.sound) this.settings.changePage({ sound: true }, 'sound');
    void this.feedback.sound.wake().then(() => {
      this.offerSound();
      this.motion.sample();
    });
  }

  private receiveSettings(settings: ProgramSettings): void {
    if (settings.paused !== this.paused) this.voice.say(settings.paused ? 'Paused: no force.' : 'Resumed.', Importance.news);
    this.paused = settings.paused;
    element('pause').textContent = this.paused ? 'Resume' : 'Pause';
    this.stage.element.toggleAttribute('data-paused', this.paused);
    this.readouts.status(this.paused ? 'paused' : 'running', this.paused ? 'Paused' : 'Touching');
    this.settings.receive(settings);
  }

  // The program.

  private opened(): void {
    this.connected = true;
    this.settings.connected();
    this.connection.send({ type: 'visible', visible: !document.hidden });
  }

  private closed({ sentence, final }: Loss): void {
    this.connected = false;
    this.narrator.forget();
    this.names.forget();
    this.actions.blank();
    this.readouts.blank();
    this.feedback.removeProbesExcept([]);
    this.showProbes();
    this.alert(sentence);
    if (this.surface === null) showNoScene();
    this.readouts.status('fault', !final ? 'Not connected' : this.surface === null ? 'No access' : 'Ended');
  }

  private receive(message: ToPage): void {
    switch (message.type) {
      case 'hello':
        return this.greeted(message);
      case 'laws':
        return this.settings.setLaws(message.laws);
      case 'scene':
        this.loaded.scene = message;
        showHeading(message);
        this.readouts.setMiddle(this.loaded.middle);
        this.feedback.setNames(message.labels);
        this.trace.scene(message.kind, message.size_x_m, message.size_y_m);
        this.settings.controls.offerCells(message.cells !== null);
        this.settings.controls.offerHeight(message.kind === 'relief');
        return;
      case 'settings':
        return this.receiveSettings(message);
      case 'materials':
        return this.settings.receiveMaterials(message);
      case 'state':
        return this.receiveState(message);
      case 'words':
        return this.narrator.receive(message);
      case 'around':
        return this.names.receive(message);
      case 'notice':
        if (message.level === 'fault') return this.alert(message.text);
        if (message.level === 'recovered') this.readouts.allWell();
        if (message.level === 'named') this.names.changed();
        return this.voice.say(message.text, importanceOf(message.level));
    }
  }

  private greeted(hello: Hello): void {
    this.hello = hello;
    // Not before: a connection may be refused after it was opened, and would be reported twice.
    this.readouts.allWell();
    this.probes.page = hello.page;
    this.readouts.setDevice(hello.device);
    this.own.set(hello.probes, hello.pointer_moves, hello.hands);
    this.actions.changed();
    this.walking.allow(hello.egocentric);
    showWayBack(hello.home);
    // Moves the device's middle to the place of this page's explorer.
    if (hello.pointer_moves) this.walking.show();
    else this.walking.sendPose();
    if (hello.version !== protocolVersion) this.alert('This page and the program are of different versions: reload the page.');
  }

  private receiveRaster(frame: HeightsFrame | PictureFrame): void {
    const first = this.surface === null;
    if (!this.loaded.take(frame)) return;
    const { scene, surface, picture, cells } = this.loaded;
    if (surface === null || scene === null) return;
    if (frame.kind === 'heights') {
      this.own.setScale(surface.scale);
      this.readouts.scale = surface.scale;
      this.readouts.setUpright(surface.isUpright);
      showSteps(surface.scale);
      this.stage.element.setAttribute('aria-label', stageLabel(scene));
      if (first) this.ready();
    }
    if (!this.loaded.isComplete) return;
    this.stage.show(surface, picture, cells);
    this.walking.show();
    this.showProbes();
  }

  /** Focuses the relief, so that the announced keys work at once, unless the user has focused something else. */
  private ready(): void {
    // Where there is something to touch, unless another page has moved the probe.
    const mover = this.probes.stateOf(this.own.chosen)?.page ?? null;
    if (mover === null && this.own.movable() && this.own.current.movedAt === -Infinity) this.own.current.adopt(this.loaded.start);
    const { activeElement } = document;
    if (activeElement === null || activeElement === document.body) this.stage.element.focus({ preventScroll: true });
    this.voice.say(this.narrator.opening(), Importance.news);
  }

  private receiveState(state: State): void {
    const taken = this.probes.receive(state, performance.now());
    if (taken !== null) this.voice.say(`Another page moves probe ${taken + 1} now.`, Importance.news);
    const { states, chosen } = this.probes;
    this.readouts.state(state, chosen ?? states[0]);
    this.actions.show();
    this.showProbes();
    const { surface } = this;
    if (surface === null) return;
    this.motion.hear(surface, state.t_s);
    this.names.finder.moved(false);
    if (this.trace.running) this.frames.request();
  }

  // The probes.

  private get surface(): Surface | null {
    return this.loaded.surface;
  }
  private get scene(): Scene | null {
    return this.loaded.scene;
  }
  private heightFactor(): number {
    return this.settings.now.touch.heightFactor;
  }

  private showProbes(): void {
    if (this.surface) this.stage.probes(this.probes.views(this.surface, this.heightFactor()));
    if (this.own.pending) this.frames.request();
  }

  private frame(now: number, passed: number | null, waited: number): boolean {
    const moving = this.motion.advance(now, passed);
    this.trace.frame(now);
    this.stage.draw(waited);
    this.depth.frame();
    document.documentElement.dataset.frames = String(this.frames.count);
    return moving;
  }

  private alert(sentence: string): void {
    this.readouts.alert(sentence);
    this.voice.aloudOnly(sentence);
  }

  // User actions.

  private bindStage(): void {
    const { element: stage } = this.stage;
    bindPointers(stage, this.own, {
      surface: () => (this.connected ? this.surface : null),
      placeAt: (left, top) => this.stage.placeAt(left, top),
      wake: () => this.wake(),
      moved: () => this.frames.request(),
      came: (probe) => this.actions.came(probe),
      left: (probe) => this.actions.left(probe),
      full: () => this.actions.full(),
    });
    stage.addEventListener('click', ({ clientX, clientY }) => this.names.clicked(this.stage.placeAt(clientX, clientY)));
    stage.addEventListener('keydown', (event) => {
      this.wake();
      if (!this.connected && !['Tab', 'h', 'H', '?'].includes(event.key)) {
        if (event.key.length === 1 || event.key.startsWith('Arrow')) this.voice.say('Palpable is not connected: nothing can be felt.', Importance.answer);
        return;
      }
      if (this.stage.moveViewBy(event) || press(event, this)) event.preventDefault();
    });
  }

  private wake(): void {
    void this.feedback.sound.wake().then(() => this.offerSound());
  }

  /** Of names and settings the one that was changed last. */
  private undoOrRedo(which: 'undo' | 'redo'): void {
    if (!this.names.undoOrRedo(which)) this.settings.undoOrRedo(which);
  }

  private bindAll(): void {
    const actions: Record<string, () => void> = {
      pause: () => this.pause(),
      recentre: () => this.recentre(),
      describe: () => this.describe(),
      where: () => this.where(),
      'sound-on': () => this.turnOnSound(),
      'move-view': () => this.moveView(),
      'move-head': () => this.moveHead(),
      'zoom-in': () => this.zoom(1.25),
      'zoom-out': () => this.zoom(0.8),
      'reset-view': () => this.resetView(),
      'walk-ahead': () => this.walk({ ahead: pace, left: 0 }),
      'walk-back': () => this.walk({ ahead: -pace, left: 0 }),
      'turn-left': () => this.walk({ ahead: 0, left: turnBy }),
      'turn-right': () => this.walk({ ahead: 0, left: -turnBy }),
      pose: () => this.pose(),
      help: () => this.help(),
      places: () => this.listPlaces(),
      undo: () => this.undoOrRedo('undo'),
      redo: () => this.undoOrRedo('redo'),
      reset: () => this.settings.reset(),
      'region-here': () => this.settings.editRegion(this.probes.chosen?.label ?? 0),
      save: () => this.connection.send({ type: 'save' }),
      ...exampleActions(this.feedback, () => this.own.chosen, (words) => this.voice.say(words, Importance.answer)),
    };
    bindButtons(actions, () => this.wake());
    element('name-here').addEventListener('click', (event) => this.names.nameByButton(event));
    bindWindow({
      visibilityChanged: (visible) => this.connection.send({ type: 'visible', visible }),
      coloursChanged: () => this.settings.apply(),
      undoOrRedo: (which) => this.undoOrRedo(which),
    });
  }
}
