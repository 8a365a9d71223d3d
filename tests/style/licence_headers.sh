#!/bin/sh
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
# Fails and lists the files if a source file lacks the two-line licence header. Run in the root folder.
set -eu
missing=$(git ls-files -co --exclude-standard '*.hpp' '*.cpp' '*.ts' '*.py' '*.sh' run test .ci/run |
  xargs -r grep -L -e 'SPDX-License-Identifier: Apache-2.0')
[ -z "$missing" ] || { printf 'no licence header in:\n%s\n' "$missing"; exit 1; }
