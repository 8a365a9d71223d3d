// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/map/map_extract.hpp"

#include "palpable/core/files/file_bytes.hpp"
#include "palpable/sources/isolated/isolated.hpp"
#include "palpable/sources/map/extract_reply.hpp"

namespace palpable::sources {

Result<MapExtract> read_map_extract(const std::filesystem::path& path) {
  const auto file = read_file_bytes(path, [](std::span<const std::byte>) { return true; });
  if (!file) return file.error();
  auto reply = isolated::decode(isolated::Job::map_extract, file->view());
  auto extract = reply ? isolated::map_extract_in(reply->bytes()) : Result<MapExtract>(reply.error());
  if (!extract) extract.error().place = path.string();
  return extract;
}

}  // namespace palpable::sources
