// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/picture/photo_depth.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/text/base64.hpp"
#include "palpable/sources/picture/exif.hpp"
#include "palpable/sources/picture/file_marks.hpp"
#include "palpable/sources/picture/picture.hpp"
#include "palpable/sources/picture/picture_reply.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace palpable::sources {
namespace {

using Bytes = std::span<const std::byte>;

constexpr std::string_view kXmp("http://ns.adobe.com/xap/1.0/\0", 29);
constexpr std::string_view kExtendedXmp("http://ns.adobe.com/xmp/extension/\0", 35);

/// The XMP packet of a JPEG, followed by the extended one, assembled from its parts (XMP specification part
/// 3, 1.1.3.1).
std::string xmp_of(Bytes file) {
  std::string standard;
  std::map<std::uint32_t, std::string_view> parts;
  visit_jpeg_segments(file, [&](int marker, Bytes content) {
    if (marker != 0xE1) return;
    if (has_magic(content, kXmp)) standard += as_text(content.subspan(kXmp.size()));
    if (!has_magic(content, kExtendedXmp)) return;
    constexpr std::size_t kDigestBytes = 32;
    ByteReader reader(content, std::endian::big);
    reader.skip(kExtendedXmp.size() + kDigestBytes + 4);
    const std::uint32_t offset = reader.u32();
    if (reader.ok()) parts.emplace(offset, as_text(reader.bytes(reader.left())));
  });
  std::string all = std::move(standard);
  for (const auto& [offset, part] : parts) all += part;
  return all;
}

/// The value of a property, written as an attribute (name="value") or as an element (<name>value</name>).
std::optional<std::string_view> property(std::string_view xml, std::string_view name) {
  for (std::size_t at = xml.find(name); at != std::string_view::npos; at = xml.find(name, at + 1)) {
    std::string_view rest = xml.substr(at + name.size());
    if (rest.starts_with('>')) return rest.substr(1, std::min(rest.find('<'), rest.size()) - 1);
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n"), rest.size()));
    if (!rest.starts_with('=')) continue;
    rest.remove_prefix(std::min(rest.find_first_of("\"'"), rest.size()));
    if (rest.empty()) return std::nullopt;
    const char quote = rest.front();
    rest.remove_prefix(1);
    return rest.substr(0, rest.find(quote));
  }
  return std::nullopt;
}

std::optional<double> number(std::optional<std::string_view> text) {
  double value = 0.0;
  if (!text || std::from_chars(text->data(), text->data() + text->size(), value).ec != std::errc())
    return std::nullopt;
  return value;
}

/// Base 64 as XMP has it: with line breaks, and padding or none.
std::vector<std::byte> from_broken_lines(std::string_view text) {
  std::string digits;
  digits.reserve(text.size() + 3);
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '/') digits += c;
  if (digits.size() % 4 == 1) digits.pop_back();
  digits.append((4 - digits.size() % 4) % 4, '=');
  return from_base64(digits).value_or(std::vector<std::byte>());
}

struct Planes {
  std::string_view format;
  std::optional<double> near;
  std::optional<double> far;
};

Planes planes_in(std::string_view xml, const std::string& prefix) {
  return {property(xml, prefix + ":Format").value_or(""), number(property(xml, prefix + ":Near")),
          number(property(xml, prefix + ":Far"))};
}

Result<std::optional<PhotoDepth>> depth_from(Bytes picture, const Planes& planes, bool metres) {
  const auto image = decode_picture(picture);
  if (!image) return invalid_input("holds a depth map that " + image.error().message);
  PhotoDepth depth{Raster<float>(image->width, image->height), PhotoDepth::Coding::range_inverse, {}, {}};
  for (int y = 0; y < image->height; ++y)
    for (int x = 0; x < image->width; ++x) depth.values(x, y) = image->pixel(x, y)[0];
  if (planes.format.find("Linear") != std::string_view::npos) depth.coding = PhotoDepth::Coding::range_linear;
  const bool valid = planes.near && planes.far && *planes.near > 0.0 && *planes.far > *planes.near &&
                     std::isfinite(*planes.far);
  if (metres && valid) {
    depth.near_m = planes.near;
    depth.far_m = planes.far;
  }
  return std::optional(std::move(depth));
}

/// The appended item with this `uri`, by the container's list of lengths; the items are at the end of the
/// file, in order.
std::optional<Bytes> container_item(Bytes file, std::string_view xml, std::string_view uri) {
  std::vector<std::pair<std::string_view, std::size_t>> items;
  constexpr std::string_view kItem = "Container:Item";
  for (std::size_t at = xml.find(kItem); at != std::string_view::npos;) {
    const std::size_t next = xml.find(kItem, at + 1);
    const std::string_view one = xml.substr(at, next == std::string_view::npos ? next : next - at);
    at = next;
    const auto length = number(property(one, "Item:Length"));
    const auto name = property(one, "Item:DataURI");
    constexpr double kMaxBytes = 1e9;
    if (length && *length > 0.0 && *length < kMaxBytes)
      items.emplace_back(name.value_or(""), static_cast<std::size_t>(*length));
  }
  std::size_t end = file.size();
  for (auto item = items.rbegin(); item != items.rend(); ++item) {
    if (item->second > end) return std::nullopt;
    end -= item->second;
    if (item->first == uri) return file.subspan(end, item->second);
  }
  return std::nullopt;
}

}  // namespace

bool announces_depth(std::span<const std::byte> file) {
  if (is_heif(file)) return isolated::heif_announces_depth(file);
  if (!has_magic(file, "\xFF\xD8")) return false;
  const std::string xml = xmp_of(file);
  return property(xml, "GDepth:Data") || property(xml, "DepthMap:DepthURI");
}

Result<std::optional<PhotoDepth>> depth_in_jpeg(std::span<const std::byte> file) {
  const std::string xml = xmp_of(file);
  if (const auto data = property(xml, "GDepth:Data")) {
    const auto units = property(xml, "GDepth:Units");
    // By the specification the unit is metres if none or "m" is stated.
    return depth_from(from_broken_lines(*data), planes_in(xml, "GDepth"), !units || *units == "m");
  }
  if (const auto uri = property(xml, "DepthMap:DepthURI")) {
    const auto item = container_item(file, xml, *uri);
    if (!item)
      return invalid_input("announces a depth map that is not there: the file is cut off or was edited");
    const auto units = property(xml, "DepthMap:Units");
    constexpr std::string_view kMetres = "Meters";
    return depth_from(*item, planes_in(xml, "DepthMap"), units && (*units == kMetres || *units == "m"));
  }
  return std::optional<PhotoDepth>();
}

}  // namespace palpable::sources
