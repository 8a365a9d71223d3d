// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The page that `palpable touch` serves: its program is at the other end of a WebSocket, its preferences are in a cookie.
import { progressCookie, readProgress } from '../guide/memory';
import { preferencesCookie, readPreferences } from '../settings/preferences';
import { offerLanguages } from '../language_choice';
import { translatePage } from '../static_text';
import { Connection } from './connection';
import { HeadPanel } from './head_panel';
import { TouchPage } from './touch_page';

translatePage();
offerLanguages();
new TouchPage(
  (receiver) => new Connection(receiver),
  {
    read: () => readPreferences(document.cookie),
    keep: (preferences) => (document.cookie = preferencesCookie(preferences)),
  },
  {
    read: () => readProgress(document.cookie),
    keep: (progress) => (document.cookie = progressCookie(progress)),
  },
  (stage, target) => new HeadPanel(stage, target),
).start();
