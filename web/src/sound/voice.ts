// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Everything that is said: the live region that screen readers follow, which is also the caption on the page, and the
// browser's own speech for people without a screen reader.
import { Announcer, Importance, type Words } from './announcer';
import { element } from '../dom';

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

  /** For words that a screen reader gets in another way. */
  aloudOnly(text: string): void {
    if (!this.aloud) return;
    speechSynthesis.cancel();
    const utterance = new SpeechSynthesisUtterance(text);
    utterance.lang = document.documentElement.lang;
    speechSynthesis.speak(utterance);
  }

  /** What has to wait is said by a timer: nothing runs while nothing waits. */
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
    // A new element each time: the same words twice are said twice.
    const line = document.createElement('span');
    line.textContent = text;
    this.region.replaceChildren(line);
    this.aloudOnly(text);
  }
}
