// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The home page that `palpable` opens.
import { readPreferences } from '../settings/preferences';
import { themeOf } from '../settings/theme';
import { ShelfPage } from './shelf_page';

document.documentElement.dataset.theme = themeOf(readPreferences(document.cookie).theme);
void new ShelfPage().start();
