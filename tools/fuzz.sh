#!/usr/bin/env bash
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
# tools/fuzz.sh SECONDS: runs every fuzzer of the preset `fuzz` for this time, starting from its corpus; new inputs are kept in build/.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
failed=0 ran=0
for fuzzer in build/fuzz/bin/fuzz_*; do
  [ -x "$fuzzer" ] || continue
  name=${fuzzer##*/fuzz_}
  found=build/fuzz/corpus/$name
  mkdir -p "$found" "fuzz/corpus/$name"
  printf 'fuzzing %s for %s s\n' "$name" "$1"
  ran=$((ran + 1))
  if ! "$fuzzer" -max_total_time="$1" -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 \
    -artifact_prefix="$found/" "$found" "fuzz/corpus/$name" >"$found.log" 2>&1; then
    tail -n 30 "$found.log"
    failed=$((failed + 1))
  else
    grep -E 'number_of_executed_units|peak_rss' "$found.log"
  fi
done
[ "$ran" -gt 0 ] || { echo "there is no fuzzer in build/fuzz/bin"; exit 1; }
printf '%s fuzzers ran, %s found a fault\n' "$ran" "$failed"
[ "$failed" = 0 ]
