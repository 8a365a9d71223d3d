// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A QR code as a picture.

/** Light modules around a code: ISO/IEC 18004, 6.3.8. */
export const margin = 4;

/** The outline of the dark modules in units of one module, margin included: one rectangle for each run in a row. */
export function darkPath(side: number, code: string): string {
  let path = '';
  for (let row = 0; row < side; ++row) {
    for (let column = 0; column < side; ) {
      const start = column;
      while (column < side && code[row * side + column] === '1') ++column;
      if (column > start) path += `M${start + margin} ${row + margin}h${column - start}v1h${start - column}z`;
      else ++column;
    }
  }
  return path;
}

/** Draws the code, black on white whatever the page's colours are. */
export function drawCode(svg: SVGElement, side: number, code: string): void {
  const size = side + 2 * margin;
  svg.setAttribute('viewBox', `0 0 ${size} ${size}`);
  const name = 'http://www.w3.org/2000/svg';
  const ground = document.createElementNS(name, 'rect');
  ground.setAttribute('width', String(size));
  ground.setAttribute('height', String(size));
  ground.setAttribute('fill', '#fff');
  const dark = document.createElementNS(name, 'path');
  dark.setAttribute('d', darkPath(side, code));
  dark.setAttribute('fill', '#000');
  svg.replaceChildren(ground, dark);
}
