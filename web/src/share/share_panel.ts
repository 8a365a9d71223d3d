// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// With whom the touch is shared: shown on the pages of the program's own machine.
import { t } from '../language';
import { element } from '../dom';
import type { FromPage, Guest, Sharing } from '../generated/protocol';
import { drawCode } from './qr_picture';
import { countWords, guestName, guestWords, invitationWords, selfWords } from './words';

export interface ShareTarget {
  send(message: FromPage): void;
  say(words: string): void;
}

export class SharePanel {
  private readonly panel = element('share');
  private readonly role = element<HTMLSelectElement>('share-role');
  private readonly list = element<HTMLUListElement>('share-guests');
  private shown: Sharing | null = null;
  /** The person has asked for a link. */
  private awaits = false;

  constructor(private readonly target: ShareTarget) {
    element('share-invite').addEventListener('click', () => {
      this.awaits = true;
      target.send({ type: 'invite', role: this.role.value });
    });
    element('share-withdraw').addEventListener('click', () => {
      target.send({ type: 'withdraw' });
      element('share-invite').focus();
    });
    element('share-copy').addEventListener('click', () => void this.copy());
  }

  /** Whose page this is; null: it is one of the program's own machine. */
  greet(guest: Guest | null): void {
    const words = element('guest-words');
    words.hidden = guest === null;
    words.textContent = guest === null ? '' : selfWords(guest);
    document.documentElement.toggleAttribute('data-guest', guest !== null);
    if (guest === null) return;
    this.panel.hidden = true;
    this.target.say(selfWords(guest));
  }

  show(sharing: Sharing): void {
    this.panel.hidden = false;
    element('share-count').textContent = countWords(sharing.guests.length, sharing.places);
    element('share-fingerprint').textContent = sharing.fingerprint;
    this.showLink(sharing);
    this.showGuests(sharing.guests);
    this.shown = sharing;
  }

  private showLink({ invitation }: Sharing): void {
    element('share-open').hidden = invitation === null;
    const before = this.shown?.invitation?.link;
    if (invitation === null || invitation.link === before) return;
    element('share-link').textContent = invitation.link;
    const { other_link: link } = invitation;
    element('share-other').hidden = link === null;
    element('share-other').textContent = link && t('In a network without IPv4: {link}', { link });
    const how = invitationWords(invitation);
    element('share-how').textContent = how;
    drawCode(element('share-code') as unknown as SVGElement, invitation.side, invitation.code);
    if (this.awaits) this.target.say(t('A link was made. {how}', { how }));
    this.awaits = false;
  }

  /** Rows stay in place, so that a focused button keeps the focus. */
  private showGuests(guests: readonly Guest[]): void {
    const rows = [...this.list.children] as HTMLLIElement[];
    const isHere = (row: HTMLLIElement) => guests.some(({ guest }) => String(guest) === row.dataset.guest);
    for (const gone of rows.filter((row) => !isHere(row))) {
      if (gone.contains(document.activeElement)) element('share-invite').focus();
      gone.remove();
    }
    for (const guest of guests) {
      const known = rows.find((row) => row.dataset.guest === String(guest.guest)) ?? this.add(guest);
      known.firstElementChild!.textContent = guestWords(guest);
    }
  }

  private add({ guest, name }: Guest): HTMLLIElement {
    const row = document.createElement('li');
    row.dataset.guest = String(guest);
    const out = document.createElement('button');
    out.type = 'button';
    out.textContent = t('Show out');
    out.setAttribute('aria-label', t('Show out {name}', { name: guestName({ name }) }));
    out.addEventListener('click', () => this.target.send({ type: 'show_out', guest }));
    row.append(document.createElement('span'), ' ', out);
    this.list.append(row);
    return row;
  }

  private async copy(): Promise<void> {
    try {
      await navigator.clipboard.writeText(this.shown?.invitation?.link ?? '');
      this.target.say(t('The link is copied.'));
    } catch {
      this.target.say(t('The browser did not copy the link.'));
    }
  }
}
