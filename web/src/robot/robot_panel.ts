// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The robot whose camera is touched: its buttons, modes and state. Shown only if there is one.
import { t } from '../language';
import { element } from '../dom';
import type { FromPage, Robot, RobotFloor } from '../generated/protocol';
import { drawFloor, floorWords, placeWords } from './floor_picture';
import { batteryWords, eventWords, figureWords, isUrgent, limitWords, modeWords, stateWords } from './words';

export interface RobotTarget {
  send(message: FromPage): void;
  /** In its turn, after what is being said. */
  say(words: string): void;
  /** Said at once by the page's own speech; a screen reader gets it from the panel. */
  sayNow(words: string): void;
  connected(): boolean;
  /** Brings this page's first probe to the middle, where it drives nothing. */
  centre(): void;
  /** Says that this page's first probe rests where it is. */
  stay(): void;
  /** Focuses the surface, whose keys drive. */
  focusSurface(): void;
}

/** The keys that stop the robot wherever the focus is: Escape does so beside what it does otherwise. */
const stopKeys = ['F2', 'Escape'];
/** What holds a started robot and is said; the rest is shown only. */
const saidLimits = ['obstacle', 'off_centre'];

export class RobotPanel {
  private readonly panel = element('robot');
  private robot: Robot | null = null;
  private resting: number | null = null;

  constructor(private readonly target: RobotTarget) {
    element('robot-stop').addEventListener('click', () => this.stop());
    element('robot-start').addEventListener('click', () => this.start());
    for (const radio of this.panel.querySelectorAll<HTMLInputElement>('input[type=radio]')) radio.addEventListener('change', () => this.order(radio.value));
    // Before any other listener can take the key, also those of dialogs and text fields.
    window.addEventListener('keydown', (event) => this.pressed(event), { capture: true });
    window.addEventListener('blur', () => this.release());
  }

  get isThere(): boolean {
    return this.robot !== null;
  }

  stop(): void {
    if (!this.target.connected()) return this.alert(t('The page is not connected: it cannot stop the robot. Use its own emergency stop.'));
    this.order('stop');
  }

  /** Who drives has left the surface, or the window: the probe goes home, where it drives nothing. */
  release(): void {
    if (this.robot?.started && this.robot.mode !== 'touch') this.target.centre();
  }

  /** The connection is lost: nothing is known of the robot. */
  lost(): void {
    if (this.robot === null) return;
    element('robot-state').textContent = t('Not connected: the state of the robot is not known.');
    element('robot-figures').textContent = '';
    element<HTMLButtonElement>('robot-start').disabled = true;
  }

  show(robot: Robot): void {
    const before = this.robot;
    this.robot = robot;
    this.panel.hidden = element('robot-seen').hidden = false;
    // The program stops a robot whose page is silent: it may hang.
    this.resting ??= window.setInterval(() => this.target.stay(), 120);
    this.check('robot-mode', robot.mode);
    element('robot-view').hidden = robot.view === null;
    if (robot.view !== null) this.check('robot-view', robot.view);
    element<HTMLButtonElement>('robot-start').disabled = robot.started || robot.starting;
    this.panel.toggleAttribute('data-moving', robot.moving);
    write('robot-state', stateWords(robot));
    write('robot-mode-words', modeWords(robot));
    write('robot-figures', figureWords(robot));
    if (before !== null) this.announce(robot, before);
  }

  showFloor(floor: RobotFloor): void {
    const picture = element<HTMLCanvasElement>('robot-floor');
    const words = floorWords(floor);
    element('robot-floor-frame').hidden = false;
    drawFloor(picture, floor);
    picture.setAttribute('aria-label', t('Floor around the robot. {words}', { words }));
    write('robot-floor-words', words);
    write('robot-place', placeWords(floor));
  }

  private announce(robot: Robot, before: Robot): void {
    if (robot.events !== before.events) {
      if (isUrgent(robot)) return this.alert(eventWords(robot));
      element('robot-alert').textContent = '';
      return this.target.say(eventWords(robot));
    }
    if (robot.mode !== before.mode) return this.target.say(modeWords(robot));
    if (robot.low_battery && !before.low_battery) return this.target.say(t('The battery of the robot is low: {battery}.', { battery: batteryWords(robot) }));
    if (robot.started && saidLimits.includes(robot.limit) && before.limit !== robot.limit) this.target.say(limitWords(robot));
  }

  private alert(words: string): void {
    // A new element each time, so that a repeated sentence is announced again.
    const line = document.createElement('span');
    line.textContent = words;
    element('robot-alert').replaceChildren(line);
    this.target.sayNow(words);
  }

  private start(): void {
    this.target.centre();
    this.order('start');
    // The button is disabled by the start, and would lose the focus.
    this.target.focusSurface();
  }

  private order(word: string): void {
    this.target.send({ type: 'robot_order', word });
  }

  private pressed(event: KeyboardEvent): void {
    if (this.robot === null || !stopKeys.includes(event.key)) return;
    if (event.key === 'F2') event.preventDefault();
    this.stop();
  }

  private check(name: string, value: string): void {
    const radio = this.panel.querySelector<HTMLInputElement>(`input[name=${name}][value=${value}]`);
    if (radio !== null) radio.checked = true;
  }
}

/** Writes only differences: a change moves a reading cursor. */
function write(id: string, text: string): void {
  const target = element(id);
  if (target.textContent !== text) target.textContent = text;
}
