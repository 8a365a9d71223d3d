// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The page: what happens when the program, the clock or a person does something.
import { known, language, t } from '../language';
import type { RasterFrame } from '../codec';
import { element } from '../dom';
import { protocolVersion, type Hello, type Settings as ProgramSettings, type State, type ToPage } from '../generated/protocol';
import { bindPointers } from '../probe/pointers';
import { controlWords } from '../settings/control_words';
import type { Settings } from '../settings/settings';
import { Importance } from '../sound/announcer';
import { bindWindow } from './bindings';
import type { Loss } from '../enter';
import type { Program, Receiver } from './connection';
import { type KeptProgress } from './guided_start';
import { fillHelp, showSteps } from './help';
import { press } from './keys';
import { showHeading, showNoScene, showWayBack, stageLabel } from './scene_heading';
import { TouchParts, type FollowHead, type TouchWork } from './touch_parts';
import { type KeptPreferences } from './touch_settings';

const importanceOf = (level: string): Importance => ({ motion: Importance.motion, answer: Importance.answer, named: Importance.answer })[level] ?? Importance.news;
const pauseWords = {
  shown: { paused: t('Paused: no force.'), resumed: t('Resumed.') },
  duringReplay: { paused: t('The touch itself is paused now: no force.'), resumed: t('The touch itself goes on now.') },
};

export class TouchPage {
  private readonly parts: TouchParts;
  private hello: Hello | null = null;
  private paused = false;
  /** Whether the program is connected; otherwise nothing is felt, moved or heard. */
  private connected = false;

  /** `followHead`: null for a page without the camera. */
  constructor(connect: (receiver: Receiver) => Program, preferences: KeptPreferences, progress: KeptProgress, followHead: FollowHead | null = null) {
    const work: TouchWork = {
      opened: () => this.opened(),
      receive: (message) => this.receive(message),
      receiveRaster: (frame) => this.receiveRaster(frame),
      closed: (loss) => this.closed(loss),
      connected: () => this.connected,
      paused: () => this.paused,
      device: () => this.hello?.device ?? 'a device',
      frame: (now, passed, waited) => this.frame(now, passed, waited),
      follow: (settings) => this.follow(settings),
      sayChange: (settings, what) => this.sayChange(settings, what),
      showProbes: () => this.showProbes(),
      showState: (state) => this.showState(state),
      showStatus: () => this.showStatus(),
      wake: () => this.wake(),
      turnOnSound: () => this.turnOnSound(),
      stopRobotAsGuest: () => this.stopRobotAsGuest(),
    };
    this.parts = new TouchParts(work, connect, preferences, progress, followHead);
  }

  start(): void {
    this.bindStage();
    this.parts.keys.bind();
    bindWindow({
      visibilityChanged: (visible) => this.becameVisible(visible),
      coloursChanged: () => this.parts.settings.apply(),
      undoOrRedo: (which) => this.parts.keys.undoOrRedo(which),
    });
    fillHelp();
    this.parts.settings.apply();
    void this.parts.connection.run();
    document.documentElement.dataset.frames = '0';
  }

  private becameVisible(visible: boolean): void {
    this.parts.connection.send({ type: 'visible', visible });
    if (!visible) return;
    this.parts.own.comeBack();
    this.parts.frames.request();
  }

  // Settings.

  private follow(settings: Settings): void {
    this.parts.stage.set(settings.touch.heightFactor, settings.page);
    this.parts.depth.show();
    this.parts.head?.follow();
    this.parts.headset.follow();
    this.parts.registration.follow();
    this.parts.picture.follow();
    this.parts.voice.set(settings.page.speech);
    this.parts.feedback.set(settings);
    this.parts.readouts.redraw();
    this.offerSound();
    this.parts.replay.panel.renew();
    this.showProbes();
  }

  /** Changes of what is felt or shown are announced; other values only without a screen reader, which reads them itself. */
  private sayChange(settings: Settings, what: string): void {
    const cells = what === 'surface' && settings.page.surface === 'cells' ? this.parts.scene?.cells : undefined;
    const law = what === 'law' ? this.parts.settings.controls.law()?.title : undefined;
    if (cells) return this.parts.voice.say(cells, Importance.answer);
    if (what === 'depth-mode') return this.parts.depth.say();
    if (law !== undefined) return this.parts.voice.say(t('Force law: {law}.', { law: known(law) }), Importance.answer);
    const words = controlWords(document.activeElement);
    if (words !== null) this.parts.voice.aloudOnly(words);
  }

  /** Offered until audio runs, since browsers start it only after a user action. */
  private offerSound(): void {
    element('sound-on').hidden = this.parts.settings.now.page.sound && this.parts.feedback.sound.runs;
  }

  /** Starts audio from this click, with a sound at once. */
  private turnOnSound(): void {
    if (!this.parts.settings.now.page.sound) this.parts.settings.changePage({ sound: true }, 'sound');
    void this.parts.feedback.sound.wake().then(() => {
      this.offerSound();
      this.parts.motion.sample();
    });
  }

  private receiveSettings(settings: ProgramSettings): void {
    const words = pauseWords[this.parts.replay.isOpen ? 'duringReplay' : 'shown'];
    if (settings.paused !== this.paused) this.parts.voice.say(settings.paused ? words.paused : words.resumed, Importance.news);
    this.paused = settings.paused;
    element('pause').textContent = this.paused ? t('Resume') : t('Pause');
    this.parts.stage.element.toggleAttribute('data-paused', this.paused);
    this.showStatus();
    this.parts.settings.receive(settings);
  }

  private showStatus(): void {
    this.parts.readouts.status(this.paused ? 'paused' : 'running', this.parts.replay.isOpen ? t('Replaying') : this.paused ? t('Paused') : t('Touching'));
  }

  // The program.

  private opened(): void {
    this.connected = true;
    this.parts.settings.connected();
    this.parts.connection.send({ type: 'language', language });
    this.parts.connection.send({ type: 'visible', visible: !document.hidden });
  }

  private closed({ sentence, final }: Loss): void {
    this.connected = false;
    this.parts.narrator.forget();
    this.parts.names.forget();
    this.parts.actions.blank();
    this.parts.readouts.blank();
    this.parts.robot.lost();
    this.parts.head?.programLost();
    this.parts.feedback.removeProbesExcept([]);
    this.showProbes();
    this.alert(sentence);
    if (this.parts.surface === null) showNoScene();
    this.parts.readouts.status('fault', !final ? t('Not connected') : this.parts.surface === null ? t('No access') : t('Ended'));
  }

  private receive(message: ToPage): void {
    switch (message.type) {
      case 'hello':
        return this.greeted(message);
      case 'laws':
        return this.parts.settings.setLaws(message.laws);
      case 'scene':
        this.parts.loaded.scene = message;
        showHeading(message);
        this.parts.readouts.setMiddle(this.parts.loaded.middle);
        this.parts.feedback.setNames(message.labels);
        this.parts.trace.scene(message.kind, message.size_x_m, message.size_y_m);
        this.parts.settings.controls.offerCells(message.cells !== null);
        this.parts.settings.controls.offerHeight(message.kind === 'relief');
        return;
      case 'settings':
        return this.receiveSettings(message);
      case 'materials':
        return this.parts.settings.receiveMaterials(message);
      case 'state':
        return this.receiveState(message);
      case 'words':
        return this.parts.narrator.receive(message);
      case 'around':
        return this.parts.names.receive(message);
      case 'sharing':
        return this.parts.share.show(message);
      case 'head':
        return this.parts.head?.receive(message);
      case 'robot':
        return this.parts.robot.show(message);
      case 'robot_floor':
        return this.parts.robot.showFloor(message);
      case 'notice':
        if (message.level === 'fault') return this.alert(message.text);
        if (message.level === 'recovered') this.parts.readouts.allWell();
        if (message.level === 'named') this.parts.names.changed();
        // What the unseen touch feels is no part of a replay.
        if (message.level === 'motion' && (this.parts.replay.isOpen || this.parts.names.finder.isFollowedByKeys)) return;
        return this.parts.voice.say(message.text, importanceOf(message.level));
    }
  }

  private greeted(hello: Hello): void {
    this.hello = hello;
    // Not before: a connection may be refused after it was opened, and would be reported twice.
    this.parts.readouts.allWell();
    this.parts.probes.page = hello.page;
    this.parts.readouts.setDevice(hello.device);
    this.parts.own.set(hello.probes, hello.pointer_moves, hello.hands);
    this.parts.head?.greet(hello.finds_head);
    this.parts.registration.offer(!hello.pointer_moves && hello.guest === null);
    this.parts.share.greet(hello.guest);
    if (hello.guest !== null) this.parts.own.setGuest(hello.guest.probe);
    this.parts.actions.changed();
    this.parts.walking.allow(hello.egocentric);
    showWayBack(hello.home);
    // Moves the device's middle to the place of this page's explorer.
    if (hello.pointer_moves) this.parts.walking.show();
    else this.parts.walking.sendPose();
    if (hello.version !== protocolVersion) this.alert(t('This page and the program are of different versions: reload the page.'));
  }

  private receiveRaster(frame: RasterFrame): void {
    const first = this.parts.surface === null;
    if (!this.parts.loaded.take(frame)) return;
    const { scene, surface, picture, cells, secondView } = this.parts.loaded;
    if (surface === null || scene === null) return;
    if (frame.kind === 'heights') {
      this.parts.own.setScale(surface.scale);
      this.parts.readouts.scale = surface.scale;
      this.parts.readouts.setUpright(surface.isUpright);
      showSteps(surface.scale);
      this.parts.stage.element.setAttribute('aria-label', stageLabel(scene));
      if (first) this.ready();
    }
    if (!this.parts.loaded.isComplete) return;
    this.parts.stage.show(surface, picture, cells, secondView);
    element('second-view-choice').hidden = secondView === null;
    this.parts.registration.follow();
    this.parts.headset.follow();
    this.parts.walking.show();
    this.showProbes();
  }

  /** Focuses the relief, so that the announced keys work at once, unless the user has focused something else. */
  private ready(): void {
    // Where there is something to touch, unless another page has moved the probe.
    const mover = this.parts.probes.stateOf(this.parts.own.chosen)?.page ?? null;
    if (mover === null && this.parts.own.movable() && this.parts.own.current.movedAt === -Infinity) this.parts.own.current.adopt(this.parts.loaded.start);
    const { activeElement } = document;
    if (activeElement === null || activeElement === document.body) this.parts.stage.element.focus({ preventScroll: true });
    const offer = this.parts.guided.offer();
    this.parts.voice.say(() => this.parts.narrator.opening().then((words) => words && words + offer), Importance.news);
  }

  /** While a recording is replayed, the touch goes on unseen. */
  private receiveState(state: State): void {
    this.parts.registration.felt(state, performance.now());
    if (!this.parts.replay.isOpen) this.showState(state);
  }

  private showState(state: State): void {
    const taken = this.parts.probes.receive(state, performance.now());
    if (taken !== null) this.parts.voice.say(t('Another page moves probe {taken} now.', { taken: taken + 1 }), Importance.news);
    const { states, chosen } = this.parts.probes;
    this.parts.readouts.state(state, chosen ?? states[0]);
    this.parts.actions.show();
    this.showProbes();
    const { surface } = this.parts;
    if (surface === null) return;
    this.parts.motion.hear(surface, state.t_s);
    if (this.parts.replay.isOpen) return;
    this.parts.names.finder.moved(false);
    this.parts.guided.felt(chosen, this.parts.narrator.place());
    if (this.parts.trace.running) this.parts.frames.request();
  }

  // The probes.

  private showProbes(): void {
    if (this.parts.surface) this.parts.stage.probes(this.parts.probes.views(this.parts.surface, this.parts.heightFactor()));
    if (this.parts.own.pending) this.parts.frames.request();
  }

  private frame(now: number, passed: number | null, waited: number): boolean {
    const moving = this.parts.motion.advance(now, passed) || this.parts.replay.panel.frame(now);
    this.parts.trace.frame(now);
    this.parts.stage.draw(waited);
    this.parts.depth.frame();
    this.parts.registration.frame();
    document.documentElement.dataset.frames = String(this.parts.frames.count);
    return moving;
  }

  private alert(sentence: string): void {
    this.parts.readouts.alert(sentence);
    this.parts.voice.aloudOnly(sentence);
  }

  // User actions.

  private bindStage(): void {
    const { element: stage } = this.parts.stage;
    bindPointers(stage, this.parts.pointing, { placeAt: (left, top) => this.parts.stage.placeAt(left, top), wake: () => this.wake() });
    stage.addEventListener('click', ({ clientX, clientY }) => this.parts.names.clicked(this.parts.stage.placeAt(clientX, clientY)));
    stage.addEventListener('pointerleave', () => this.parts.robot.release());
    stage.addEventListener('keydown', (event) => {
      this.wake();
      if (!this.connected && !['Tab', 'h', 'H', '?'].includes(event.key)) {
        if (event.key.length === 1 || event.key.startsWith('Arrow')) this.parts.voice.say(t('Palpable is not connected: nothing can be felt.'), Importance.answer);
        return;
      }
      if (this.parts.stage.moveViewBy(event) || press(event, this.parts.keys)) event.preventDefault();
    });
  }

  /** A guest cannot pause the touch, and stops the robot instead; false: there is none, or this is no guest's page. */
  private stopRobotAsGuest(): boolean {
    if (!this.parts.robot.isThere || !this.parts.own.isGuest) return false;
    this.parts.robot.stop();
    return true;
  }

  private wake(): void {
    void this.parts.feedback.sound.wake().then(() => this.offerSound());
  }
}
