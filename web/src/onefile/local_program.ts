// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The page's program in the page itself: the messages of protocol.json go to the touch module and come from it.
import { t } from '../language';
import { readMessage, readRaster, writeMessage } from '../codec';
import type { FromPage, ToPage } from '../generated/protocol';
import type { Program, Receiver } from '../home/connection';
import type { TouchModule } from './touch_module';

/** Longest time that a frame may have to catch up with (s): a page that was hidden does not. */
const mostBehind = 0.1;

export class LocalProgram implements Program {
  private touch: TouchModule | null = null;
  /** When the touch was last advanced; null at rest. */
  private advancedAt: number | null = null;
  private delivers = false;

  /** `opened`: the touch with its scene; it is rejected with the sentence to show. */
  constructor(
    private readonly receiver: Receiver,
    private readonly opened: Promise<TouchModule>,
  ) {}

  async run(): Promise<void> {
    try {
      this.touch = await this.opened;
    } catch (error) {
      return this.receiver.closed({ sentence: error instanceof Error ? error.message : String(error), final: true });
    }
    this.receiver.opened();
    this.deliver(this.touch);
    this.wake();
  }

  send(message: FromPage): void {
    if (this.touch === null) return;
    this.touch.receive(writeMessage(message));
    this.deliver(this.touch);
    this.wake();
  }

  private wake(): void {
    if (this.advancedAt !== null) return;
    this.advancedAt = performance.now();
    requestAnimationFrame(() => this.advance());
  }

  private advance(): void {
    if (this.touch === null || this.advancedAt === null) return;
    const now = performance.now();
    const moves = this.touch.advance(Math.min(mostBehind, (now - this.advancedAt) / 1000));
    this.advancedAt = moves ? now : null;
    this.deliver(this.touch);
    if (moves) requestAnimationFrame(() => this.advance());
  }

  /** A frame may make the page send a message, whose answers wait until the page has finished with that frame. */
  private deliver(touch: TouchModule): void {
    if (this.delivers) return;
    this.delivers = true;
    try {
      for (const frame of touch.frames()) this.deliverFrame(frame);
    } finally {
      this.delivers = false;
    }
  }

  private deliverFrame(frame: string | ArrayBuffer): void {
    const read = typeof frame === 'string' ? readMessage(frame) : readRaster(frame);
    if (typeof read === 'string') this.receiver.closed({ sentence: t('The page’s parts do not fit together: {read}.', { read }), final: true });
    else if ('kind' in read && !('type' in read)) this.receiver.raster(read);
    else this.receiver.message(read as ToPage);
  }
}
