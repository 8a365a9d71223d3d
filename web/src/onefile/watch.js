// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Runs before everything else in a one-file page: of a file that was cut off, the page's own script may be missing; where
// its bytes were changed, the browser refuses it. It runs before this event, and sets window.palpable.
addEventListener('DOMContentLoaded', () => {
  const isComplete = document.getElementById('data-end') !== null;
  if (isComplete && 'palpable' in window) return;
  const sentence = isComplete
    ? 'This file is damaged, or this browser is too old for it: its program cannot be run. Get it again from where it came from.'
    : 'This file is incomplete: its end is missing. Get it again from where it came from.';
  const banner = document.getElementById('banner') ?? document.body.appendChild(document.createElement('p'));
  banner.setAttribute('role', 'alert');
  banner.textContent = sentence;
  banner.hidden = false;
  const words = { 'scene-name': 'No scene', status: isComplete ? 'Damaged' : 'Incomplete' };
  for (const [id, text] of Object.entries(words)) {
    const element = document.getElementById(id);
    if (element) element.textContent = text;
  }
});
