// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// How files come to the home page: chosen, taken with the camera, dropped, pasted.
import { t } from '../language';
import { element } from '../dom';

export interface ArrivalTarget {
  files(files: readonly File[]): void;
  refused(sentence: string): void;
}

function bindPicker(button: string, input: string, target: ArrivalTarget): void {
  const picker = element<HTMLInputElement>(input);
  element(button).onclick = () => picker.click();
  picker.onchange = () => {
    const files = [...(picker.files ?? [])];
    // The same file can be chosen again.
    picker.value = '';
    target.files(files);
  };
}

function bindDrop(target: ArrivalTarget): void {
  const shown = element('drop');
  const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
  document.addEventListener('dragover', (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    shown.hidden = false;
  });
  document.addEventListener('dragleave', (event) => {
    if (event.relatedTarget === null) shown.hidden = true;
  });
  document.addEventListener('drop', (event) => {
    shown.hidden = true;
    if (!hasFiles(event)) return;
    // Otherwise the browser would leave this page for the file.
    event.preventDefault();
    const items = [...(event.dataTransfer?.items ?? [])];
    if (items.some((item) => item.webkitGetAsEntry?.()?.isDirectory))
      return target.refused(t('A folder cannot be opened here: choose the files in it.'));
    target.files([...(event.dataTransfer?.files ?? [])]);
  });
}

export function bindArrivals(target: ArrivalTarget): void {
  bindPicker('choose', 'files', target);
  bindPicker('camera', 'camera-file', target);
  bindDrop(target);
  document.addEventListener('paste', (event) => {
    const files = [...(event.clipboardData?.files ?? [])];
    if (files.length === 0) return;
    event.preventDefault();
    target.files(files);
  });
}
