// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The home page that `palpable` opens.
import { readPreferences } from '../settings/preferences';
import { themeOf } from '../settings/theme';
import { offerLanguages } from '../language_choice';
import { translatePage } from '../static_text';
import { ShelfPage } from './shelf_page';

document.documentElement.dataset.theme = themeOf(readPreferences(document.cookie).theme);
translatePage();
offerLanguages();
void new ShelfPage().start();
