// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What a robot has seen of the floor, as a small picture with the robot in its middle, and in words.
import type { RobotFloor } from '../generated/protocol';
import { fixed, t } from '../language';

const metres = (value: number): string => fixed(value, 1);

function aheadWords({ ahead_m, ahead_ends }: RobotFloor): string {
  const distance = metres(ahead_m);
  if (ahead_ends === 'blocked') return t('Free for {distance} m ahead, then blocked.', { distance });
  if (ahead_ends === 'unknown') return t('Free for {distance} m ahead, then not seen.', { distance });
  return t('Free for {distance} m ahead at least.', { distance });
}

function sideWords(left: number | null, right: number | null): string {
  if (left === null && right === null) return t('Nothing is known to be in the way at its sides.');
  if (right === null) return t('Blocked to the left at {left} m.', { left: metres(left!) });
  if (left === null) return t('Blocked to the right at {right} m.', { right: metres(right) });
  return t('Blocked to the left at {left} m, to the right at {right} m.', { left: metres(left), right: metres(right) });
}

/** What the picture shows: distances are from the robot's border. */
export const floorWords = (floor: RobotFloor): string => `${aheadWords(floor)} ${sideWords(floor.left_m, floor.right_m)}`;

/** Where the robot is by its odometry, which begins anywhere. */
export const placeWords = ({ x_m, y_m, heading_deg }: RobotFloor): string =>
  t('Place by odometry: {x}, {y} m, heading {heading}°', { x: metres(x_m), y: metres(y_m), heading: Math.round(heading_deg) });

/** Draws it in the page's colours: blocked cells are the darkest, cells that were not seen are hatched. */
export function drawFloor(canvas: HTMLCanvasElement, { side, cells, radius_m, cell_m }: RobotFloor): void {
  const context = canvas.getContext('2d');
  if (context === null) return;
  const cell = 4;
  canvas.width = canvas.height = side * cell;
  const colours = getComputedStyle(canvas);
  const colour = (name: string): string => colours.getPropertyValue(name).trim();
  context.fillStyle = colour('--card');
  context.fillRect(0, 0, canvas.width, canvas.height);
  [...cells].forEach((kind, k) => {
    const left = (k % side) * cell;
    const top = Math.floor(k / side) * cell;
    if (kind === '2') {
      context.fillStyle = colour('--ink');
      context.fillRect(left, top, cell, cell);
    } else if (kind === '0') {
      context.fillStyle = colour('--edge');
      context.fillRect(left + (Math.floor(top / cell) % 2) * 2, top + 1, 2, 1);
    }
  });
  drawRobot(context, canvas.width / 2, (radius_m / cell_m) * cell, colour('--marble'));
}

/** Ahead is up. */
function drawRobot(context: CanvasRenderingContext2D, middle: number, radius: number, colour: string): void {
  context.strokeStyle = context.fillStyle = colour;
  context.lineWidth = 3;
  context.beginPath();
  context.arc(middle, middle, radius, 0, 2 * Math.PI);
  context.stroke();
  context.beginPath();
  context.moveTo(middle, middle - 1.6 * radius);
  context.lineTo(middle - 0.5 * radius, middle);
  context.lineTo(middle + 0.5 * radius, middle);
  context.fill();
}
