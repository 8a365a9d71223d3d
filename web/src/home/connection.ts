// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The WebSocket to the program.
import { known, t } from '../language';
import { readMessage, readRaster, writeMessage, type RasterFrame } from '../codec';
import { enter, type Loss } from '../enter';
import type { FromPage, ToPage } from '../generated/protocol';

export interface Receiver {
  opened(): void;
  message(message: ToPage): void;
  raster(frame: RasterFrame): void;
  closed(loss: Loss): void;
}

/** What the page talks to. */
export interface Program {
  /** Connects, and passes what the program sends to its receiver. */
  run(): Promise<void>;
  send(message: FromPage): void;
}

const wait = (ms: number) => new Promise<void>((resolve) => setTimeout(resolve, ms));
/** Resolves when the user enters another address, with a new token. */
const newAddress = () => new Promise<void>((resolve) => window.addEventListener('hashchange', () => resolve(), { once: true }));
const firstDelay = 500;
const longestDelay = 5000;

export class Connection implements Program {
  private socket: WebSocket | null = null;

  constructor(private readonly receiver: Receiver) {}

  /** Connects; reconnects after a loss, and after a refusal when the address has changed. */
  async run(): Promise<void> {
    for (let delay = firstDelay; ; ) {
      const refused = await enter();
      const talk = refused === null ? await this.talk() : null;
      const loss = refused ?? lossOf(talk!.reason);
      this.receiver.closed(loss);
      delay = talk?.opened ? firstDelay : Math.min(longestDelay, delay * 2);
      await (loss.final ? newAddress() : Promise.race([wait(delay), newAddress()]));
    }
  }

  send(message: FromPage): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(writeMessage(message));
  }

  private talk(): Promise<{ reason: string; opened: boolean }> {
    return new Promise((resolve) => {
      const socket = new WebSocket(`${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/socket`);
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
          complaint = t('the program sent something that this page does not understand ({read})', { read });
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

function lossOf(reason: string): Loss {
  if (reason === 'the session has ended') return { sentence: t('The session has ended. Start palpable again to go on.'), final: true };
  if (reason === 'another scene was opened') return { sentence: t('Another scene was opened in another page. It will be shown here, too.'), final: false };
  if (reason === 'shown out') return { sentence: t('The person who shares the scene has ended your access.'), final: true };
  if (reason === 'opened in another tab') return { sentence: t('The scene was opened again on this device, and goes on there.'), final: true };
  return { sentence: reason === '' ? t('The connection was lost. Trying again.') : t('The connection was lost: {reason}. Trying again.', { reason: known(reason) }), final: false };
}
