#!/bin/sh
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
# Fails and lists the links if a document links to a file of the project that does not exist. Run in the root folder.
set -eu
missing=$(git ls-files -co --exclude-standard '*.md' | while read -r document; do
  grep -oE '\]\([^)#]+' "$document" | sed 's/^](//' | grep -vE '^(https?|mailto):' | while read -r target; do
    [ -e "$(dirname "$document")/$target" ] || printf '%s: %s\n' "$document" "$target"
  done
done)
[ -z "$missing" ] || { printf 'links to nothing:\n%s\n' "$missing"; exit 1; }
