#!/usr/bin/env bash
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
# tools/coverage.sh: prints the share of lines run by the tests of the preset `coverage`, by module.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
report=build/coverage/gcov
rm -rf "$report" && mkdir -p "$report"
find build/coverage/src -name '*.gcda' -print0 |
  (cd "$report" && xargs -0 -I{} realpath --relative-to=. "../../../{}" | xargs -r gcov --json-format >/dev/null)
python3 tools/coverage.py "$report"/*.gcov.json.gz
