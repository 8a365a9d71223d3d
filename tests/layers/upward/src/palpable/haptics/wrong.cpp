// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Wrong on purpose: the layer test must refuse it.
#include "palpable/vision/stereo/problem/stereo.hpp"
