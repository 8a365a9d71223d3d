#!/usr/bin/env bash
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
# in_a_copy.sh PROGRAM SAMPLES COMMAND…: runs the command in a fresh folder that looks like the project's root to a
# document's example: samples/ is a copy, ./run is the program.
set -euo pipefail
program=$1 samples=$2
shift 2
room=$(mktemp -d)
trap 'rm -rf "$room"' EXIT
cd "$room"
if [ -d "$samples" ]; then cp -r "$samples" samples; fi
ln -s "$program" run
"$@"
