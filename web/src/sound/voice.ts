// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Speech output: the live region for screen readers, which is also the caption on the page, and the browser's speech for
// people without a screen reader.
import { Announcer, Importance, type Words } from './announcer';
import { element } from '../dom';
import { isEnglish, setSent } from '../sent_language';

export class Voice {
  private aloud = false;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly region = element('spoken');
  private readonly announcer = new Announcer((text) => this.utter(text));

  set(aloud: boolean): void {
    const can = 'speechSynthesis' in window;
    if (can && !aloud && this.aloud) speechSynthesis.cancel();
    this.aloud = aloud && can;
  }

  say(words: Words | string, importance: Importance): void {
    this.announcer.say(words, importance, performance.now());
    this.wait();
  }

  /** For sentences that a screen reader gets otherwise. */
  aloudOnly(text: string): void {
    if (!this.aloud) return;
    speechSynthesis.cancel();
    const utterance = new SpeechSynthesisUtterance(text);
    utterance.lang = isEnglish(text) ? 'en' : document.documentElement.lang;
    speechSynthesis.speak(utterance);
  }

  /** Waiting sentences are said by a timer, which runs only while something waits. */
  private wait(): void {
    const due = this.announcer.due(performance.now());
    if (due === null || this.timer !== undefined) return;
    this.timer = setTimeout(() => {
      this.timer = undefined;
      this.announcer.tick(performance.now());
      this.wait();
    }, due + 1);
  }

  private utter(text: string): void {
    // A new element each time, so that a repeated sentence is announced again.
    const line = document.createElement('span');
    setSent(line, text);
    this.region.replaceChildren(line);
    this.aloudOnly(text);
  }
}
