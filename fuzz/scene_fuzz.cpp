// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/byte_reader.hpp"
#include "palpable/formats/scene_file.hpp"

#include <cstdlib>

// The bytes are tried as a whole file, and as the scene.json of an archive whose checksums are right, so that
// the parser behind the checksums is met too. A scene that can be read can be written.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpable::formats;
  const auto file = std::as_bytes(std::span(data, size));
  const auto scene = decode_scene(file);
  if (scene && !encode_scene(scene->scene, scene->others)) std::abort();
  const auto archive = zip({{"scene.json", Bytes(file.begin(), file.end())}});
  if (archive) static_cast<void>(decode_scene(*archive));
  return 0;
}
