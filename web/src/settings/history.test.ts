// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { History } from './history';

describe('history', () => {
  it('undoes and redoes every step', () => {
    const history = new History(0);
    history.change(1, 'a', 0);
    history.change(2, 'b', 1);
    expect([history.undo(), history.now, history.undo(), history.now, history.undo()]).toEqual([true, 1, true, 0, false]);
    expect([history.redo(), history.redo(), history.redo(), history.now]).toEqual([true, true, false, 2]);
  });
  it('counts each drag of a slider as one step', () => {
    const history = new History(0);
    for (let i = 1; i <= 10; ++i) history.change(i, 'slider', i * 50);
    for (let i = 11; i <= 20; ++i) history.change(i, 'slider', 5000 + i * 50);
    history.undo();
    expect(history.now).toBe(10);
    history.undo();
    expect(history.now).toBe(0);
  });
  it('starts a new step after an undo, even of the same slider', () => {
    const history = new History(0);
    history.change(1, 'slider', 0);
    history.undo();
    history.change(2, 'slider', 10);
    history.undo();
    expect(history.now).toBe(0);
  });
  it('drops undone steps after a new change', () => {
    const history = new History(0);
    history.change(1, 'a', 0);
    history.undo();
    history.change(2, 'b', 5000);
    expect(history.canRedo).toBe(false);
  });
});
