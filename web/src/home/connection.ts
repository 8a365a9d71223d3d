// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The way in (the address's token for a cookie, once) and the socket that follows it.
import { readMessage, readRaster, writeMessage, type HeightsFrame, type PictureFrame } from '../codec';
import type { FromPage, ToPage } from '../generated/protocol';

export interface Receiver {
  opened(): void;
  message(message: ToPage): void;
  raster(frame: HeightsFrame | PictureFrame): void;
  /** `final`: it will not be tried again. */
  closed(sentence: string, final: boolean): void;
}

/** Lets this browser in. Returns null, or the sentence that says why not. */
async function enter(): Promise<string | null> {
  const token = location.hash.slice(1);
  try {
    const reply = await (token === ''
      ? fetch('/session')
      : fetch('/session', { method: 'POST', body: token, headers: { 'Content-Type': 'text/plain' } }));
    // The token is spent: nobody needs to see it in the address, or to find it in the history.
    if (token !== '') history.replaceState(null, '', location.pathname);
    return reply.ok ? null : await reply.text();
  } catch {
    return 'Palpable does not answer: it has probably ended.';
  }
}

const wait = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));
const firstDelay = 500;
const longestDelay = 5000;

export class Connection {
  private socket: WebSocket | null = null;

  constructor(private readonly receiver: Receiver) {}

  /** Connects, and connects again after a loss, until the program refuses. */
  async run(): Promise<void> {
    for (let delay = firstDelay; ; delay = Math.min(longestDelay, delay * 2)) {
      const refusal = await enter();
      const answers = refusal === null || !refusal.startsWith('Palpable does not answer');
      if (refusal !== null && answers) return this.receiver.closed(refusal, true);
      if (refusal === null) {
        const { reason, opened } = await this.talk();
        if (opened) delay = firstDelay;
        const ended = reason === 'the session has ended';
        this.receiver.closed(ended ? 'The session has ended. Start palpable again to go on.' : `The connection was lost${reason === '' ? '' : `: ${reason}`}. Trying again.`, ended);
        if (ended) return;
      } else {
        this.receiver.closed(refusal, false);
      }
      await wait(delay);
    }
  }

  send(message: FromPage): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(writeMessage(message));
  }

  private talk(): Promise<{ reason: string; opened: boolean }> {
    return new Promise((resolve) => {
      const socket = new WebSocket(`ws://${location.host}/socket`);
      socket.binaryType = 'arraybuffer';
      this.socket = socket;
      let opened = false;
      let complaint = '';
      socket.onopen = () => {
        opened = true;
        this.receiver.opened();
      };
      socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => {
        const read = typeof data === 'string' ? readMessage(data) : readRaster(data);
        if (typeof read === 'string') {
          complaint = `the program sent something that this page does not understand (${read})`;
          socket.close();
        } else if ('kind' in read && !('type' in read)) {
          this.receiver.raster(read);
        } else {
          this.receiver.message(read as ToPage);
        }
      };
      socket.onclose = ({ reason }) => resolve({ reason: complaint || reason, opened });
    });
  }
}
