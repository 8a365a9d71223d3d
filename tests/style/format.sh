#!/bin/sh
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
# format.sh CLANG-FORMAT: fails, and names the lines, if a C++ file of the project is not formatted. Run in its root.
set -eu
git ls-files -co --exclude-standard '*.hpp' '*.cpp' | xargs "$1" --dry-run --Werror
