// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/formats/packing/zstd_frame.hpp"
#include "palpable/formats/scene/scene_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

namespace {

using palpable::formats::Bytes;

/// An archive in which every member that the description names holds `content`, compressed, with correct
/// checksums.
Bytes archive_of(std::span<const std::byte> description, std::span<const std::byte> content) {
  using namespace palpable;
  constexpr int kLevel = 1;
  formats::ZipMembers members{{"scene.json", Bytes(description.begin(), description.end())}};
  const auto frame = formats::zstd_frame(content, kLevel);
  const auto json = nlohmann::json::parse(as_text(description), nullptr, false);
  const auto add = [&](const nlohmann::json& name) {
    if (frame && name.is_string() && name != "scene.json") members[name.get<std::string>()] = *frame;
  };
  if (json.is_object() && json.contains("model") && json["model"].is_object())
    for (const auto& value : json["model"]) {
      add(value);
      if (value.is_structured())
        for (const auto& part : value) add(part);
    }
  const auto archive = formats::zip(members);
  return archive ? *archive : Bytes();
}

}  // namespace

// The bytes are tried as a whole file; as the scene.json of an archive with correct checksums, which
// exercises the parser; and as a description with the content of its members. A scene that can be read can be
// written.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpable::formats;
  const auto file = std::as_bytes(std::span(data, size));
  const auto scene = decode_scene(file);
  if (scene && !encode_scene(scene->scene, scene->others)) std::abort();
  const auto archive = zip({{"scene.json", Bytes(file.begin(), file.end())}});
  if (archive) static_cast<void>(decode_scene(*archive));
  if (size < 2) return 0;
  // Two bytes for the length of the description, the description, then the content of the model's members.
  const std::size_t length = std::min(data[0] | (std::size_t{data[1]} << 8U), size - 2);
  const auto packed = archive_of(file.subspan(2, length), file.subspan(2 + length));
  const auto unpacked = decode_scene(packed);
  if (unpacked && !encode_scene(unpacked->scene, unpacked->others)) std::abort();
  return 0;
}
