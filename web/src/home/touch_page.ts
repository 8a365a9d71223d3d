// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The page: connects the program, the stage, the settings, the keys, sound and speech.
import { known, language, t } from '../language';
import type { RasterFrame } from '../codec';
import { element } from '../dom';
import { protocolVersion, type Hello, type Scene, type Settings as ProgramSettings, type State, type ToPage } from '../generated/protocol';
import { Names } from '../names/names';
import { bindPointers, Pointing } from '../probe/pointers';
import { ProbeActions } from '../probe/probe_actions';
import { Probes } from '../probe/probes';
import { Walking } from '../probe/walking';
import { controlWords } from '../settings/control_words';
import type { Settings } from '../settings/settings';
import { Importance } from '../sound/announcer';
import { RobotPanel } from '../robot/robot_panel';
import { SharePanel } from '../share/share_panel';
import { Feedback } from '../sound/feedback';
import { Voice } from '../sound/voice';
import type { Surface } from '../surface';
import { TracePanel } from '../trace/trace_panel';
import { Stage } from '../view/stage';
import { bindWindow } from './bindings';
import type { Loss } from '../enter';
import type { Program, Receiver } from './connection';
import { DepthPanel, type DepthTarget } from './depth_panel';
import { FrameLoop } from './frame_loop';
import { GuidedStart, type GuidedPage, type KeptProgress } from './guided_start';
import type { HeadPanel } from './head_panel';
import { HeadsetPanel } from './headset_panel';
import { fillHelp, showSteps } from './help';
import { press } from './keys';
import { Narrator } from './narrator';
import { ProbeMotion } from './probe_motion';
import { Readouts } from './readouts';
import { RegistrationPanel } from './registration_panel';
import { Replay } from './replay';
import { showHeading, showNoScene, showWayBack, stageLabel } from './scene_heading';
import { SceneFrames } from './scene_frames';
import { TouchActions } from './touch_actions';
import { TouchSettings, type KeptPreferences } from './touch_settings';
import { ViewActions } from './view_actions';

const importanceOf = (level: string): Importance => ({ motion: Importance.motion, answer: Importance.answer, named: Importance.answer })[level] ?? Importance.news;
const pauseWords = {
  shown: { paused: t('Paused: no force.'), resumed: t('Resumed.') },
  duringReplay: { paused: t('The touch itself is paused now: no force.'), resumed: t('The touch itself goes on now.') },
};

export class TouchPage {
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
      found: () => this.guided.found(),
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
    connected: () => this.isLive,
    heightFactor: () => this.heightFactor(),
    device: () => this.hello?.device ?? 'a device',
    say: (words, importance) => this.voice.say(words, importance),
    send: (message) => this.connection.send(message),
    moves: () => this.frames.request(),
    draw: () => this.showProbes(),
  });
  private readonly pointing = new Pointing(this.own, {
    surface: () => (this.isLive ? this.surface : null),
    moved: () => this.frames.request(),
    came: (probe) => this.actions.came(probe),
    left: (probe) => this.actions.left(probe),
    full: () => this.actions.full(),
  });
  private readonly picture: ViewActions;
  private readonly depth: DepthPanel;
  private readonly guided: GuidedStart;
  private readonly replay: Replay;
  private readonly keys: TouchActions;
  private readonly head: HeadPanel | null;
  private readonly headset: HeadsetPanel;
  private readonly registration: RegistrationPanel;
  private readonly share: SharePanel;
  private readonly robot: RobotPanel;
  private hello: Hello | null = null;
  private paused = false;
  /** Whether the program is connected; otherwise nothing is felt, moved or heard. */
  private connected = false;

  /** `followHead`: null for a page without the camera. */
  constructor(
    connect: (receiver: Receiver) => Program,
    preferences: KeptPreferences,
    progress: KeptProgress,
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
      tell: (words) => this.voice.say(words, Importance.news),
    };
    this.depth = new DepthPanel(this.stage, depth);
    this.head = followHead?.(this.stage, depth) ?? null;
    this.registration = new RegistrationPanel(this.stage, {
      ...depth,
      scene: () => this.scene,
      heightFactor: () => this.heightFactor(),
      paused: () => this.paused,
      pause: () => this.connection.send({ type: 'pause', paused: true }),
      begun: () => this.guided.withdraw(),
    });
    this.headset = new HeadsetPanel(this.stage, {
      frames: this.frames,
      pointing: this.pointing,
      page: depth.page,
      surface: () => this.surface,
      say: depth.say,
      wake: () => this.wake(),
      hold: (pads) => this.feedback.vibrator.hold(pads),
    });
    this.guided = new GuidedStart(this.guidedPage(), progress);
    this.replay = new Replay({
      probes: this.probes,
      readouts: this.readouts,
      stage: this.stage,
      sound: this.feedback.sound,
      scene: () => this.scene,
      surface: () => this.surface,
      heightFactor: () => this.heightFactor(),
      showState: (state) => this.showState(state),
      showStatus: () => this.showStatus(),
      opened: () => {
        this.guided.withdraw();
        // The touch goes on unseen.
        if (this.robot.isThere) this.robot.stop();
      },
      draw: () => this.showProbes(),
      byDevice: () => !this.own.movable(0),
      pause: () => this.connection.send({ type: 'pause', paused: true }),
      paused: () => this.paused,
      request: () => this.frames.request(),
      say: (words, importance) => this.voice.say(words, importance),
    });
    this.keys = this.touchActions();
    this.share = new SharePanel({
      send: (message) => this.connection.send(message),
      say: (words) => this.voice.say(words, Importance.answer),
    });
    this.robot = new RobotPanel({
      send: (message) => this.connection.send(message),
      say: (words) => this.voice.say(words, Importance.answer),
      sayNow: (words) => this.voice.aloudOnly(words),
      connected: () => this.connected,
      centre: () => this.motion.centre(0),
      stay: () => this.motion.stay(0),
      focusSurface: () => this.stage.element.focus({ preventScroll: true }),
    });
  }

  start(): void {
    this.bindStage();
    this.keys.bind();
    bindWindow({
      visibilityChanged: (visible) => this.becameVisible(visible),
      coloursChanged: () => this.settings.apply(),
      undoOrRedo: (which) => this.keys.undoOrRedo(which),
    });
    fillHelp();
    this.settings.apply();
    void this.connection.run();
    document.documentElement.dataset.frames = '0';
  }

  private guidedPage(): GuidedPage {
    return {
      situation: () => ({ kind: this.scene?.kind ?? '', sound: this.settings.now.page.sound }),
      byDevice: () => !this.own.movable(),
      surface: () => this.surface,
      heightFactor: () => this.heightFactor(),
      place: () => this.narrator.place(),
      say: (words, importance) => this.voice.say(words, importance),
      mark: (points) => this.stage.line(points),
    };
  }

  private touchActions(): TouchActions {
    return new TouchActions({
      motion: this.motion,
      narrator: this.narrator,
      names: this.names,
      walking: this.walking,
      probes: this.probes,
      probeActions: this.actions,
      settings: this.settings,
      picture: this.picture,
      feedback: this.feedback,
      guided: this.guided,
      headset: this.headset,
      replay: this.replay.panel,
      stopRobot: () => this.stopRobotAsGuest(),
      paused: () => this.paused,
      say: (words, importance) => this.voice.say(words, importance),
      send: (message) => this.connection.send(message),
      request: () => this.frames.request(),
      wake: () => this.wake(),
      turnOnSound: () => this.turnOnSound(),
    });
  }

  private becameVisible(visible: boolean): void {
    this.connection.send({ type: 'visible', visible });
    if (!visible) return;
    this.own.comeBack();
    this.frames.request();
  }

  // Settings.

  private follow(settings: Settings): void {
    this.stage.set(settings.touch.heightFactor, settings.page);
    this.depth.show();
    this.head?.follow();
    this.headset.follow();
    this.registration.follow();
    this.picture.follow();
    this.voice.set(settings.page.speech);
    this.feedback.set(settings);
    this.readouts.redraw();
    this.offerSound();
    this.replay.panel.renew();
    this.showProbes();
  }

  /** Changes of what is felt or shown are announced; other values only without a screen reader, which reads them itself. */
  private sayChange(settings: Settings, what: string): void {
    const cells = what === 'surface' && settings.page.surface === 'cells' ? this.scene?.cells : undefined;
    const law = what === 'law' ? this.settings.controls.law()?.title : undefined;
    if (cells) return this.voice.say(cells, Importance.answer);
    if (what === 'depth-mode') return this.depth.say();
    if (law !== undefined) return this.voice.say(t('Force law: {law}.', { law: known(law) }), Importance.answer);
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
    const words = pauseWords[this.replay.isOpen ? 'duringReplay' : 'shown'];
    if (settings.paused !== this.paused) this.voice.say(settings.paused ? words.paused : words.resumed, Importance.news);
    this.paused = settings.paused;
    element('pause').textContent = this.paused ? t('Resume') : t('Pause');
    this.stage.element.toggleAttribute('data-paused', this.paused);
    this.showStatus();
    this.settings.receive(settings);
  }

  private showStatus(): void {
    this.readouts.status(this.paused ? 'paused' : 'running', this.replay.isOpen ? t('Replaying') : this.paused ? t('Paused') : t('Touching'));
  }

  // The program.

  private opened(): void {
    this.connected = true;
    this.settings.connected();
    this.connection.send({ type: 'language', language });
    this.connection.send({ type: 'visible', visible: !document.hidden });
  }

  private closed({ sentence, final }: Loss): void {
    this.connected = false;
    this.narrator.forget();
    this.names.forget();
    this.actions.blank();
    this.readouts.blank();
    this.robot.lost();
    this.feedback.removeProbesExcept([]);
    this.showProbes();
    this.alert(sentence);
    if (this.surface === null) showNoScene();
    this.readouts.status('fault', !final ? t('Not connected') : this.surface === null ? t('No access') : t('Ended'));
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
      case 'sharing':
        return this.share.show(message);
      case 'robot':
        return this.robot.show(message);
      case 'robot_floor':
        return this.robot.showFloor(message);
      case 'notice':
        if (message.level === 'fault') return this.alert(message.text);
        if (message.level === 'recovered') this.readouts.allWell();
        if (message.level === 'named') this.names.changed();
        // What the unseen touch feels is no part of a replay.
        if (message.level === 'motion' && (this.replay.isOpen || this.names.finder.isFollowedByKeys)) return;
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
    this.registration.offer(!hello.pointer_moves && hello.guest === null);
    this.share.greet(hello.guest);
    if (hello.guest !== null) this.own.setGuest(hello.guest.probe);
    this.actions.changed();
    this.walking.allow(hello.egocentric);
    showWayBack(hello.home);
    // Moves the device's middle to the place of this page's explorer.
    if (hello.pointer_moves) this.walking.show();
    else this.walking.sendPose();
    if (hello.version !== protocolVersion) this.alert(t('This page and the program are of different versions: reload the page.'));
  }

  private receiveRaster(frame: RasterFrame): void {
    const first = this.surface === null;
    if (!this.loaded.take(frame)) return;
    const { scene, surface, picture, cells, secondView } = this.loaded;
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
    this.stage.show(surface, picture, cells, secondView);
    element('second-view-choice').hidden = secondView === null;
    this.registration.follow();
    this.headset.follow();
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
    const offer = this.guided.offer();
    this.voice.say(() => this.narrator.opening().then((words) => words && words + offer), Importance.news);
  }

  /** While a recording is replayed, the touch goes on unseen. */
  private receiveState(state: State): void {
    this.registration.felt(state, performance.now());
    if (!this.replay.isOpen) this.showState(state);
  }

  private showState(state: State): void {
    const taken = this.probes.receive(state, performance.now());
    if (taken !== null) this.voice.say(t('Another page moves probe {taken} now.', { taken: taken + 1 }), Importance.news);
    const { states, chosen } = this.probes;
    this.readouts.state(state, chosen ?? states[0]);
    this.actions.show();
    this.showProbes();
    const { surface } = this;
    if (surface === null) return;
    this.motion.hear(surface, state.t_s);
    if (this.replay.isOpen) return;
    this.names.finder.moved(false);
    this.guided.felt(chosen, this.narrator.place());
    if (this.trace.running) this.frames.request();
  }

  // The probes.

  private get surface(): Surface | null {
    return this.loaded.surface;
  }
  private get scene(): Scene | null {
    return this.loaded.scene;
  }
  /** Whether the page shows the touch itself, and moves probes. */
  private get isLive(): boolean {
    return this.connected && !this.replay.isOpen;
  }
  private heightFactor(): number {
    return this.settings.now.touch.heightFactor;
  }

  private showProbes(): void {
    if (this.surface) this.stage.probes(this.probes.views(this.surface, this.heightFactor()));
    if (this.own.pending) this.frames.request();
  }

  private frame(now: number, passed: number | null, waited: number): boolean {
    const moving = this.motion.advance(now, passed) || this.replay.panel.frame(now);
    this.trace.frame(now);
    this.stage.draw(waited);
    this.depth.frame();
    this.registration.frame();
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
    bindPointers(stage, this.pointing, { placeAt: (left, top) => this.stage.placeAt(left, top), wake: () => this.wake() });
    stage.addEventListener('click', ({ clientX, clientY }) => this.names.clicked(this.stage.placeAt(clientX, clientY)));
    stage.addEventListener('pointerleave', () => this.robot.release());
    stage.addEventListener('keydown', (event) => {
      this.wake();
      if (!this.connected && !['Tab', 'h', 'H', '?'].includes(event.key)) {
        if (event.key.length === 1 || event.key.startsWith('Arrow')) this.voice.say(t('Palpable is not connected: nothing can be felt.'), Importance.answer);
        return;
      }
      if (this.stage.moveViewBy(event) || press(event, this.keys)) event.preventDefault();
    });
  }

  /** A guest cannot pause the touch, and stops the robot instead; false: there is none, or this is no guest's page. */
  private stopRobotAsGuest(): boolean {
    if (!this.robot.isThere || !this.own.isGuest) return false;
    this.robot.stop();
    return true;
  }

  private wake(): void {
    void this.feedback.sound.wake().then(() => this.offerSound());
  }
}
