// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0

// A program with every object file of the servo's side (CMakeLists.txt links the whole archives). Its shared
// libraries are therefore all that core, models, device and haptics can need.
int main() { return 0; }
