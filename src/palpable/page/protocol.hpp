// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/page/protocol.gen.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace palpable::page::protocol {

/// Parses one text frame of the page strictly: valid UTF-8 JSON, one object of a known `type`, with all
/// fields of the right type and within their limits, and no others; nested objects likewise. Errors: one
/// sentence that names the field.
Result<FromPage> parse_from_page(std::string_view text);
/// The same for a message of the home page.
Result<FromShelf> parse_from_shelf(std::string_view text);

/// The text frame of a message. Numbers that are not finite become 0, others are clamped to their limits, and
/// invalid UTF-8 becomes the replacement character, so that the page's strict parser accepts it.
template <class Message>
std::string write_message(const Message& message);

/// Binary frames (protocol.json, "raster").
/// `kind`: heights or shift.
std::string write_floats(RasterKind kind, std::uint32_t scene, const Raster<float>& values);
/// `kind`: picture, cells or second.
std::string write_picture(RasterKind kind, std::uint32_t scene, const Raster<Rgb8>& picture);

/// The raster reduced to at most `longest_side` columns and rows by block means. An empty or small enough
/// raster is returned unchanged.
Raster<float> thinned(const Raster<float>& raster, int longest_side);
Raster<Rgb8> thinned(const Raster<Rgb8>& raster, int longest_side);

}  // namespace palpable::page::protocol
