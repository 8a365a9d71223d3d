// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Runs before everything else in a one-file page: of a file that was cut off, the page's own script may be missing.
addEventListener('DOMContentLoaded', () => {
  if (document.getElementById('data-end')) return;
  const sentence = 'This file is incomplete: its end is missing. Get it again from where it came from.';
  const banner = document.getElementById('banner') ?? document.body.appendChild(document.createElement('p'));
  banner.setAttribute('role', 'alert');
  banner.textContent = sentence;
  banner.hidden = false;
  const words = { 'scene-name': 'No scene', status: 'Incomplete' };
  for (const [id, text] of Object.entries(words)) {
    const element = document.getElementById(id);
    if (element) element.textContent = text;
  }
});
