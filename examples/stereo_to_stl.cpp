// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A stereo pair becomes a relief that a 3D printer prints: stereo_to_stl LEFT RIGHT OUT.stl
#include <cstdio>
#include <fstream>

#include <palpable/palpable.hpp>

using namespace palpable;

int main(int argc, char** argv) {
  if (argc != 4) return std::puts("stereo_to_stl LEFT RIGHT OUT.stl"), 2;
  auto left = sources::read_picture(argv[1]);
  if (!left) return std::puts(left.error().sentence().c_str()), 1;
  auto right = sources::read_picture(argv[2]);
  if (!right) return std::puts(right.error().sentence().c_str()), 1;

  auto pair = vision::rectify_uncalibrated({*std::move(left), *std::move(right), {}}, Work{});
  if (!pair) return std::puts(pair.error().sentence().c_str()), 1;
  recipes::StereoRecipe stereo;
  stereo.method = vision::StereoMethod::fast;
  recipes::ReliefRecipe recipe;
  recipe.relief.size_m = Vec3{0.10, 0.10, 0.015};
  const auto made = recipes::relief_from_pair(pair->pair, stereo, recipe, Work{});
  if (!made) return std::puts(made.error().sentence().c_str()), 1;
  for (const Note& note : made->notes) std::puts(note.sentence.c_str());

  const auto stl = formats::encode_stl(models::solid_of(*models::relief_of(made->scene)));
  if (!stl) return std::puts(stl.error().sentence().c_str()), 1;
  std::ofstream file(argv[3], std::ios::binary);
  file.write(reinterpret_cast<const char*>(stl->data()), static_cast<std::streamsize>(stl->size()));
  return file ? 0 : 1;
}
