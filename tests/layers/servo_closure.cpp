// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0

// A program that holds every object file of the servo's side (CMakeLists.txt links the archives whole), so
// that the shared libraries it needs are all that core, models, device and haptics can ever need.
int main() { return 0; }
