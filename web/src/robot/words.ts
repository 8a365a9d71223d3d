// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A robot's state in words.
import type { Robot } from '../generated/protocol';
import { fixed, t } from '../language';

/** What happened last to its start and stop; empty: nothing yet. */
const events: Record<string, string> = {
  none: '',
  not_ready: t('The robot is not started: its odometry, or pictures of its camera with their data and depth, do not come.'),
  stopped: t('The robot is stopped.'),
  touched: t('The robot touches something: it is stopped, and must be started again.'),
  link_lost: t('The robot is stopped: its connection was lost.'),
  odometry_lost: t('The robot is stopped: its odometry does not come. Start it again when it does.'),
  picture_lost: t('The robot is stopped: no usable picture of its camera comes. Start it again when it sees.'),
  stalled: t('The robot is stopped, since the program stood still. Start it again.'),
  moved_unasked: t('The robot moves, though it is told to stand: use its own emergency stop.'),
  stays: t('The robot is stopped: it was told to move, and its odometry says that it stands. It may be blocked, or its odometry hangs.'),
};

const limits: Record<string, string> = {
  released: t('It stands: the hand is released.'),
  off_centre: t('It stands: bring the hand to the middle first.'),
  link_lost: t('It stands: its odometry does not come.'),
  picture_lost: t('It stands: no usable picture of its camera comes.'),
  standing: t('It stands, and is touched.'),
  obstacle: t('There is something ahead of the robot, or floor that it has not seen.'),
};

const lacks: Record<string, string> = {
  link: t('It cannot be started: it is not connected.'),
  odometry: t('It cannot be started: its odometry does not come.'),
  picture: t('It cannot be started: no usable picture of its camera comes.'),
};

const modes: Record<string, string> = {
  drive: t('Drive: up drives the robot, right and left turn it.'),
  look: t('Look: right and left turn the robot.'),
  touch: t('Touch: the robot stands, and the hand touches what its camera sees.'),
};

export const modeWords = ({ mode }: Robot): string => modes[mode] ?? mode;

const startedWords = ({ vouched_m }: Robot): string =>
  t('The robot is started. The floor within {distance} m around it, which its camera does not see, must be free.', { distance: fixed(vouched_m, 2) });

/** Of the last event. */
export const eventWords = (robot: Robot): string => (robot.event === 'started' ? startedWords(robot) : (events[robot.event] ?? ''));

/** Whether an event must interrupt: the robot stands, or should. */
export const isUrgent = ({ event }: Robot): boolean => event !== 'started' && event !== 'not_ready' && event !== 'none';

/** Why it stands or goes slowly, while it is started; empty: nothing holds it. */
export const limitWords = ({ limit }: Robot): string => limits[limit] ?? '';

/** Whether it moves, and why not. */
export function stateWords(robot: Robot): string {
  if (robot.starting) return t('The start is waited for.');
  if (robot.started) return [robot.moving ? t('Started, and moves.') : t('Started, and stands.'), limitWords(robot)].filter((part) => part !== '').join(' ');
  const why = robot.event === 'started' ? '' : eventWords(robot);
  const lack = lacks[robot.lacks] ?? '';
  return [why === '' ? t('Not started: nothing is sent to the robot.') : why, robot.event === 'not_ready' ? '' : lack].filter((part) => part !== '').join(' ');
}

export const batteryWords = ({ battery }: Robot): string => t('Battery {percent} %', { percent: Math.round(100 * (battery ?? 0)) });

/** Its figures: battery, and how old the newest picture is. */
export function figureWords(robot: Robot): string {
  const age = robot.picture_age_s;
  const picture = age === null ? t('No picture yet') : age < 0.5 ? t('Newest picture less than half a second old') : t('Newest picture {age} s old', { age: fixed(age, 1) });
  return [robot.battery === null ? '' : batteryWords(robot), picture].filter((part) => part !== '').join(' · ');
}
