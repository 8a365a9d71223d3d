// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Wrong on purpose: cmake/CheckLayers.cmake must refuse it.
#include "palpable/vision/stereo/cost/census.hpp"
