// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/page/protocol.gen.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace palpable::page::protocol {

/// Reads one text frame of the page, strictly: valid UTF-8 JSON, one object of a known `type`, every field
/// there, of its type and within its limits, and no others; so for the objects in it. Errors: one sentence
/// that names the field.
Result<FromPage> parse_from_page(std::string_view text);

/// The text frame of a message. Numbers that are not finite become 0, those beyond their limits the nearest
/// limit, bytes that are not UTF-8 the replacement character: the page's strict reader never refuses it.
template <class Message>
std::string write_message(const Message& message);

/// Binary frames (protocol.json, "raster").
std::string write_heights(std::uint32_t scene, const Raster<float>& height_m);
/// `kind`: picture or cells.
std::string write_picture(RasterKind kind, std::uint32_t scene, const Raster<Rgb8>& picture);

/// The raster with at most `longest_side` columns and rows: means over whole blocks, so that thin peaks keep
/// their place (the corner cases: an empty raster and one small enough come back unchanged).
Raster<float> thinned(const Raster<float>& raster, int longest_side);
Raster<Rgb8> thinned(const Raster<Rgb8>& raster, int longest_side);

}  // namespace palpable::page::protocol
