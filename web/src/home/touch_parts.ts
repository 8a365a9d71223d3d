// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The parts of the page, and what each of them needs from the others.
import type { RasterFrame } from '../codec';
import { type Scene, type State, type ToPage } from '../generated/protocol';
import { Names } from '../names/names';
import { Pointing } from '../probe/pointers';
import { ProbeActions } from '../probe/probe_actions';
import { Probes } from '../probe/probes';
import { Walking } from '../probe/walking';
import type { Settings } from '../settings/settings';
import { Importance } from '../sound/announcer';
import { RobotPanel } from '../robot/robot_panel';
import { SharePanel } from '../share/share_panel';
import { Feedback } from '../sound/feedback';
import { Voice } from '../sound/voice';
import type { Surface } from '../surface';
import { TracePanel } from '../trace/trace_panel';
import { Stage } from '../view/stage';
import type { Loss } from '../enter';
import type { Program, Receiver } from './connection';
import { DepthPanel, type DepthTarget } from './depth_panel';
import { FrameLoop } from './frame_loop';
import { GuidedStart, type GuidedPage, type KeptProgress } from './guided_start';
import type { HeadPanel, HeadTarget } from './head_panel';
import { HeadsetPanel } from './headset_panel';
import { Narrator } from './narrator';
import { ProbeMotion } from './probe_motion';
import { Readouts } from './readouts';
import { RegistrationPanel } from './registration_panel';
import { Replay } from './replay';
import { SceneFrames } from './scene_frames';
import { TouchActions } from './touch_actions';
import { TouchSettings, type KeptPreferences } from './touch_settings';
import { ViewActions } from './view_actions';

/** What the page as a whole does for its parts. */
export interface TouchWork {
  opened(): void;
  receive(message: ToPage): void;
  receiveRaster(frame: RasterFrame): void;
  closed(loss: Loss): void;
  /** Whether the program is connected; otherwise nothing is felt, moved or heard. */
  connected(): boolean;
  paused(): boolean;
  device(): string;
  frame(now: number, passed: number | null, waited: number): boolean;
  follow(settings: Settings): void;
  sayChange(settings: Settings, what: string): void;
  showProbes(): void;
  showState(state: State): void;
  showStatus(): void;
  wake(): void;
  turnOnSound(): void;
  stopRobotAsGuest(): boolean;
}

export type FollowHead = (stage: Stage, target: HeadTarget) => HeadPanel;

export class TouchParts {
  readonly connection: Program;
  readonly frames = new FrameLoop((now, passed, waited) => this.work.frame(now, passed, waited));
  readonly settings: TouchSettings;
  readonly stage: Stage;
  readonly voice = new Voice();
  readonly feedback = new Feedback((sentence) => this.voice.say(sentence, Importance.news));
  readonly readouts = new Readouts();
  readonly probes = new Probes();
  readonly own = this.probes.own;
  readonly loaded = new SceneFrames();
  readonly narrator = new Narrator(this.loaded, this.probes, (message) => this.connection.send(message));
  readonly actions = new ProbeActions(this.probes, {
    surface: () => this.surface,
    say: (words, importance) => this.voice.say(words, importance),
    send: (message) => this.connection.send(message),
    chosenWords: (what) => this.narrator.chosen(what),
    allWords: () => this.narrator.all(),
    draw: () => this.work.showProbes(),
  });
  readonly walking = new Walking(this.own, {
    surface: () => this.surface,
    say: (words) => this.voice.say(words, Importance.answer),
    send: (message) => this.connection.send(message),
    showPose: (pose) => this.readouts.pose(pose),
    // On contours the line is the current trace.
    arrow: (points) => this.scene?.kind !== 'contours' && this.stage.line(points),
  });
  readonly names = new Names(
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
  readonly trace = new TracePanel({
    place: () => this.narrator.place(),
    say: (words) => this.voice.say(words, Importance.answer),
    overlay: (points) => this.stage.line(points),
  });
  readonly motion = new ProbeMotion(this.probes, this.narrator, this.walking, this.names.finder, this.feedback, {
    scene: () => this.scene,
    surface: () => this.surface,
    connected: () => this.isLive,
    heightFactor: () => this.heightFactor(),
    device: () => this.work.device(),
    say: (words, importance) => this.voice.say(words, importance),
    send: (message) => this.connection.send(message),
    moves: () => this.frames.request(),
    draw: () => this.work.showProbes(),
  });
  readonly pointing = new Pointing(this.own, {
    surface: () => (this.isLive ? this.surface : null),
    moved: () => this.frames.request(),
    came: (probe) => this.actions.came(probe),
    left: (probe) => this.actions.left(probe),
    full: () => this.actions.full(),
  });
  readonly picture: ViewActions;
  readonly depth: DepthPanel;
  readonly guided: GuidedStart;
  readonly replay: Replay;
  readonly keys: TouchActions;
  readonly head: HeadPanel | null;
  readonly headset: HeadsetPanel;
  readonly registration: RegistrationPanel;
  readonly share: SharePanel;
  readonly robot: RobotPanel;

  /** `followHead`: null for a page without the camera. */
  constructor(
    private readonly work: TouchWork,
    connect: (receiver: Receiver) => Program,
    preferences: KeptPreferences,
    progress: KeptProgress,
    followHead: FollowHead | null,
  ) {
    this.connection = connect({
      opened: () => this.work.opened(),
      message: (message) => this.work.receive(message),
      raster: (frame) => this.work.receiveRaster(frame),
      closed: (loss) => this.work.closed(loss),
    });
    this.settings = new TouchSettings(preferences, {
      send: (message) => this.connection.send(message),
      say: (words) => this.voice.say(words, Importance.answer),
      follow: (settings) => this.work.follow(settings),
      changed: (settings, what) => this.work.sayChange(settings, what),
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
    this.head = followHead?.(this.stage, { ...depth, send: (message) => this.connection.send(message) }) ?? null;
    this.registration = new RegistrationPanel(this.stage, {
      ...depth,
      scene: () => this.scene,
      heightFactor: () => this.heightFactor(),
      paused: () => this.work.paused(),
      pause: () => this.connection.send({ type: 'pause', paused: true }),
      begun: () => this.guided.withdraw(),
    });
    this.headset = new HeadsetPanel(this.stage, {
      frames: this.frames,
      pointing: this.pointing,
      page: depth.page,
      surface: () => this.surface,
      say: depth.say,
      wake: () => this.work.wake(),
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
      showState: (state) => this.work.showState(state),
      showStatus: () => this.work.showStatus(),
      opened: () => {
        this.guided.withdraw();
        // The touch goes on unseen.
        if (this.robot.isThere) this.robot.stop();
      },
      draw: () => this.work.showProbes(),
      byDevice: () => !this.own.movable(0),
      pause: () => this.connection.send({ type: 'pause', paused: true }),
      paused: () => this.work.paused(),
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
      connected: () => this.work.connected(),
      centre: () => this.motion.centre(0),
      stay: () => this.motion.stay(0),
      focusSurface: () => this.stage.element.focus({ preventScroll: true }),
    });
  }

  get surface(): Surface | null {
    return this.loaded.surface;
  }
  get scene(): Scene | null {
    return this.loaded.scene;
  }
  /** Whether the page shows the touch itself, and moves probes. */
  get isLive(): boolean {
    return this.work.connected() && !this.replay.isOpen;
  }
  heightFactor(): number {
    return this.settings.now.touch.heightFactor;
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
      stopRobot: () => this.work.stopRobotAsGuest(),
      paused: () => this.work.paused(),
      say: (words, importance) => this.voice.say(words, importance),
      send: (message) => this.connection.send(message),
      request: () => this.frames.request(),
      wake: () => this.work.wake(),
      turnOnSound: () => this.work.turnOnSound(),
    });
  }
}
