#!/bin/sh
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
# build.sh TOOLCHAIN GENERATOR NODE required|optional OUT.wasm
# Compiles the touch to WebAssembly in build/wasm, which all build folders share. If that fails, `optional` gives an empty
# file and says what is left out.
set -eu
toolchain=$1 generator=$2 node=$3 need=$4 out=$5
here=$(dirname "$(readlink -f "$0")")
root=$(readlink -f "$here/../../../..")
wasm=$root/build/wasm
mkdir -p "$wasm"
exec 9> "$wasm/lock"
flock 9
# Debian's emscripten looks for its own modules where Debian's node has them.
export NODE_PATH="${NODE_PATH:-/usr/share/nodejs}"
compile() {
  "$node" "$root/web/scripts/protocol.mjs" --cpp "$wasm/generated/palpable/page/protocol.gen.hpp" &&
    cmake -S "$here" -B "$wasm" -G "$generator" -DCMAKE_BUILD_TYPE=Release -DCMAKE_TOOLCHAIN_FILE="$toolchain" \
      -DGENERATED="$wasm/generated" &&
    cmake --build "$wasm"
}
if compile > "$wasm/build.log" 2>&1; then
  cp "$wasm/touch.wasm" "$out"
elif [ "$need" = optional ]; then
  echo "palpable: emscripten cannot compile the touch (build/wasm/build.log): export SCENE -o x.html is left out"
  : > "$out"
else
  cat "$wasm/build.log"
  exit 1
fi
