// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import { raster } from '../generated/protocol';
import { LocalProgram } from './local_program';
import type { TouchModule } from './touch_module';

/** A raster frame of one sample. */
function frameOf(kind: 'heights' | 'picture'): ArrayBuffer {
  const frame = new ArrayBuffer(4 * raster.header.length + (kind === 'heights' ? 4 : 3));
  const view = new DataView(frame);
  [raster.magic, raster.kinds[kind], 0, 1, 1].forEach((value, i) => view.setUint32(4 * i, value, true));
  return frame;
}

it('passes a frame only after the page has finished with the one before, though that sent a message', async () => {
  const waiting = [frameOf('heights'), frameOf('picture')];
  let received = 0;
  const touch = {
    receive: () => ++received,
    advance: () => false,
    *frames() {
      for (let frame = waiting.shift(); frame !== undefined; frame = waiting.shift()) yield frame;
    },
  };
  const order: string[] = [];
  const program: LocalProgram = new LocalProgram(
    {
      opened: () => undefined,
      message: () => undefined,
      closed: ({ sentence }) => order.push(sentence),
      raster: ({ kind }) => {
        order.push(`${kind} begins`);
        program.send({ type: 'ask', serial: 1 } as unknown as Parameters<LocalProgram['send']>[0]);
        order.push(`${kind} ends`);
      },
    },
    Promise.resolve(touch as unknown as TouchModule),
  );
  globalThis.requestAnimationFrame ??= () => 0;
  await program.run();
  expect(order).toEqual(['heights begins', 'heights ends', 'picture begins', 'picture ends']);
  expect(received).toBe(2);
});
