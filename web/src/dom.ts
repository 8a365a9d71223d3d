// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The elements of index.html.

/** The element with this id; throws if the page has none. */
export function element<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (found === null) throw new Error(`the page has no element ${id}`);
  return found as T;
}
