// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0

// Renders the sample pair, its exact disparity and its labels into a folder: render_sample FOLDER. Run by
// hand when the scene is changed; sculpture_test compares the committed files with what the code gives.
#include "palpable/core/work.hpp"
#include "palpable/formats/picture/picture.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "sculpture.hpp"

namespace {

using namespace palpable;

int fail(const Error& error) {
  std::fprintf(stderr, "render_sample: %s\n", error.sentence().c_str());
  return static_cast<int>(error.code);
}

Raster<Rgb8> picture(const samples::View& view, samples::Eye eye) {
  Raster<Rgb8> out(view.rig.left.width, view.rig.left.height);
  parallel_for({}, out.height(), 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      std::ranges::copy(samples::render_row(view, eye, y), out.row(y).begin());
  });
  return out;
}

Raster<float> disparity(const samples::View& view) {
  Raster<float> out(view.rig.left.width, view.rig.left.height);
  parallel_for({}, out.height(), 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) std::ranges::copy(samples::disparity_row(view, y), out.row(y).begin());
  });
  return out;
}

Raster<std::uint8_t> labels(const samples::View& view) {
  Raster<std::uint8_t> out(view.rig.left.width, view.rig.left.height);
  parallel_for({}, out.height(), 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) std::ranges::copy(samples::label_row(view, y), out.row(y).begin());
  });
  return out;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: render_sample FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder(arguments[1]);
  const samples::View view = samples::sculpture_view();
  const auto left = formats::write_png(folder / "sculpture_left.png", picture(view, samples::Eye::left));
  if (!left) return fail(left.error());
  const auto right = formats::write_png(folder / "sculpture_right.png", picture(view, samples::Eye::right));
  if (!right) return fail(right.error());
  const auto truth = formats::write_disparity_png(folder / "sculpture_disparity.png", disparity(view));
  if (!truth) return fail(truth.error());
  const auto objects = formats::write_png(folder / "sculpture_labels.png", labels(view));
  return objects ? 0 : fail(objects.error());
}
