// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Gives the person a file that the page has made.

export function download(name: string, content: Blob): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
