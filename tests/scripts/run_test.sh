#!/usr/bin/env bash
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
# run_test.sh PROJECT: runs ./run in a copy of the project in which apt, sudo, cmake, ninja and the program are stubs that
# record their calls.
set -uo pipefail
project=$1
room=$(mktemp -d)
trap 'rm -rf "$room"' EXIT
failures=0
expect() { # expect WHAT CONDITION…
  local what=$1
  shift
  if "$@"; then printf 'ok    %s\n' "$what"; else
    printf 'FAILS %s\n' "$what"
    failures=$((failures + 1))
  fi
}
stand_in() { # stand_in NAME: a program made of standard input
  printf '#!/bin/bash\n' >"$room/bin/$1"
  cat >>"$room/bin/$1"
  chmod +x "$room/bin/$1"
}
calls_of() { grep -c "^$1" "$room/calls"; }

mkdir -p "$room/bin" "$room/project/tools" "$room/project/packages" "$room/project/build/run/bin"
cp "$project/run" "$room/project/"
cp "$project/tools/setup.sh" "$room/project/tools/"
printf 'present\nabsent  # why\n\nnodejs\nnpm\n' >"$room/project/packages/build.txt"
printf 'present\n' >"$room/project/packages/run.txt"
: >"$room/project/packages/test.txt"
: >"$room/project/build/run/build.ninja"
stand_in dpkg-query <<<'[ "${*: -1}" = absent ] && [ ! -e '"$room"'/installed ] || printf installed'
stand_in apt-get <<<'echo "apt-get $*" >>'"$room"'/calls; case "$*" in *install*) touch '"$room"'/installed ;; esac; echo "noise of apt"'
stand_in sudo <<<'echo "sudo $*" >>'"$room"'/calls; [ ! -e '"$room"'/password ] || exit 1; [ "$1" = -n ] && shift; exec "$@"'
stand_in id <<<'echo 1000'
stand_in node <<<'echo 20'
stand_in npm <<<''
stand_in ninja <<<'[ -e '"$room"'/broken ] && { echo "error: broken"; exit 1; }; echo "ninja: no work to do."'
stand_in ../project/build/run/bin/palpable <<<'printf "<%s>" "$PWD" "$@"'
unset CI
run() { (cd "$room" && PATH=$room/bin:$PATH project/run "$@" </dev/null >out 2>err); }

: >"$room/calls"
touch "$room/password"
run info
expect 'without a terminal a password is not asked for' [ $? -eq 1 ]
expect 'a message says what to install' grep -q 'sudo apt-get install absent' "$room/err"
expect 'the program was not started' [ ! -s "$room/out" ]
rm "$room/password"

: >"$room/calls"
run make 'two words' '' '*'
expect 'arguments are passed unchanged, in the caller'"'"'s folder' [ "$(<"$room/out")" = "<$room><make><two words><><*>" ]
expect 'only missing packages are installed' grep -q 'install -y --no-install-recommends absent$' "$room/calls"
expect 'the output of apt is not on standard output' grep -q 'noise of apt' "$room/err"

: >"$room/calls"
run
expect 'without arguments the home page is opened' [ "$(<"$room/out")" = "<$room><home>" ]
expect 'nothing is installed twice' [ "$(calls_of apt-get)" -eq 0 ]
expect 'nothing is printed when there is nothing to do' [ ! -s "$room/err" ]

# Another build holds the lock for a moment.
(flock "$room/project/build/.setup/lock" sleep 2) &
sleep 0.3
(cd "$room" && PATH=$room/bin:$PATH project/run info </dev/null >out 2>&-)
expect 'it waits for another build where nobody hears that' [ "$(<"$room/out")" = "<$room><info>" ]
wait

touch "$room/broken"
run info
expect 'a failed build is a failure' [ $? -eq 1 ]
expect 'after it the program is not started' [ ! -s "$room/out" ]
expect 'after it the reason is shown' grep -q 'error: broken' "$room/err"
rm "$room/broken"

: >"$room/calls"
printf 'absent2\n' >>"$room/project/packages/run.txt"
stand_in dpkg-query <<<'[ "${*: -1}" = absent2 ] && [ ! -e '"$room"'/installed2 ] || printf installed'
run -y info
expect 'with -y the argument is not the program'"'"'s' [ "$(<"$room/out")" = "<$room><info>" ]
expect 'with -y sudo is used without asking' grep -q '^sudo .*install -y --no-install-recommends absent2$' "$room/calls"
touch "$room/installed2"
stand_in dpkg-query <<<'[ "${*: -1}" = absent ] && [ ! -e '"$room"'/installed ] || printf installed'

mv "$room/project/build" "$room/built"
: >"$room/project/build"
run info
expect 'a clone that cannot be written is a failure' [ $? -eq 1 ]
expect 'a message says what to do instead' grep -q 'build a clone of your own' "$room/err"
rm "$room/project/build"
mv "$room/built" "$room/project/build"

printf 'absent\n' >>"$room/project/packages/run.txt"
rm "$room/installed"
run
expect 'a longer list is checked again' [ "$(calls_of apt-get)" -ge 1 ]

[ "$failures" -eq 0 ]
