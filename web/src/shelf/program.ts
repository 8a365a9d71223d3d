// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The home page's messages to the program, and the files that it sends.
import { t } from '../language';
import { readShelfMessage, writeMessage } from '../codec';
import type { FromShelf, ToShelf, Uploaded } from '../generated/protocol';

/** A refusal, as a sentence for the person. */
export class Refusal extends Error {}

const silent = t('Palpable does not answer: it has probably ended. Start it again.');

function understood<Type extends ToShelf['type']>(text: string, type: Type): Extract<ToShelf, { type: Type }> {
  const message = readShelfMessage(text);
  if (typeof message === 'string' || message.type !== type)
    throw new Refusal(t('The program answered something that this page does not understand: reload the page.'));
  return message as Extract<ToShelf, { type: Type }>;
}

/** Sends a message; the answer is of this type. Throws a Refusal. */
export async function tell<Type extends ToShelf['type']>(message: FromShelf, type: Type): Promise<Extract<ToShelf, { type: Type }>> {
  let reply: Response;
  let text: string;
  try {
    reply = await fetch('/shelf', { method: 'POST', body: writeMessage(message), headers: { 'Content-Type': 'text/plain' } });
    text = await reply.text();
  } catch {
    throw new Refusal(silent);
  }
  if (!reply.ok) throw new Refusal(text);
  return understood(text, type);
}

export interface Sending {
  /** Rejects with a Refusal. */
  done: Promise<Uploaded>;
  stop(): void;
}

/** Sends a file; `onPart` is told the fraction that has arrived. */
export function sendFile(file: File, onPart: (fraction: number) => void): Sending {
  const request = new XMLHttpRequest();
  const done = new Promise<Uploaded>((resolve, reject) => {
    request.upload.onprogress = ({ loaded, total }) => onPart(total > 0 ? loaded / total : 0);
    request.onload = () => {
      try {
        if (request.status !== 200) throw new Refusal(request.responseText);
        resolve(understood(request.responseText, 'uploaded'));
      } catch (refusal) {
        reject(refusal as Refusal);
      }
    };
    request.onerror = () => reject(new Refusal(t('{name}: could not be read or sent.', { name: file.name })));
    request.onabort = () => reject(new Refusal(t('{name}: was not sent.', { name: file.name })));
  });
  request.open('POST', `/upload/${encodeURIComponent(file.name)}`);
  request.setRequestHeader('Content-Type', 'application/octet-stream');
  request.send(file);
  return { done, stop: () => request.abort() };
}
