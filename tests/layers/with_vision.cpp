// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0

// Wrong on purpose: CheckLinks.cmake must refuse a program that needs OpenCV.
#include <opencv2/core.hpp>

int main() { return cv::getNumThreads() > 0 ? 0 : 1; }
