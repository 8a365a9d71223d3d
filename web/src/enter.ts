// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Authentication: the address's token is exchanged for a cookie, once.

import { t } from './language';

export interface Loss {
  sentence: string;
  /** Whether there is no automatic retry. */
  final: boolean;
}

/** Exchanges the token for a cookie; null, or the reason of a refusal. */
export async function enter(): Promise<Loss | null> {
  const token = location.hash.slice(1);
  try {
    const reply = await (token === ''
      ? fetch('/session')
      : fetch('/session', { method: 'POST', body: token, headers: { 'Content-Type': 'text/plain' } }));
    // The token is used up: remove it from the address and the history.
    if (token !== '') history.replaceState(null, '', location.pathname);
    // Refusals for too many pages are temporary; those without a cookie are final.
    return reply.ok ? null : { sentence: await reply.text(), final: reply.status !== 503 };
  } catch {
    return { sentence: t('Palpable does not answer: it has probably ended. Trying again.'), final: false };
  }
}
