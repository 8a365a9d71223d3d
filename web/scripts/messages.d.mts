// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
export interface SourceString {
  text: string;
  isMessage: boolean;
  line: number;
}
export function sources(folder?: string): string[];
export function stringsOf(path: string): SourceString[];
export function messagesOfHtml(path: string): string[];
export function allMessages(): string[];
export function programMessages(): string[];
