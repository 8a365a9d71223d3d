// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/calibration/calibration_reply.hpp"
#include "palpable/sources/map/extract_reply.hpp"
#include "palpable/sources/picture/picture_reply.hpp"
#include "palpable/sources/solid/mesh_reply.hpp"

#include <cstdint>
#include <cstdlib>
#include <span>

// Replies of a compromised decoder process: everything in a reply is checked before it is used.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpable::sources::isolated;
  const auto reply = std::as_bytes(std::span(data, size));
  if (const auto mesh = mesh_in(reply))
    for (const auto& triangle : mesh->triangles)
      for (const std::uint32_t corner : triangle)
        if (corner >= mesh->vertices_m.size()) std::abort();
  if (const auto image = image_in(reply)) {
    const auto samples = static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height) *
                         static_cast<std::size_t>(image->channels);
    if (image->samples.size() != samples) std::abort();
  }
  static_cast<void>(raster_in(reply));
  static_cast<void>(photo_depth_in(reply));
  static_cast<void>(calibration_in(reply));
  if (const auto extract = map_extract_in(reply)) static_cast<void>(reply_of(*extract));
  return 0;
}
