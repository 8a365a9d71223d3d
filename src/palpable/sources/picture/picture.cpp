// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/picture/picture.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/formats/picture/jpeg.hpp"
#include "palpable/formats/picture/pfm.hpp"
#include "palpable/formats/picture/png.hpp"
#include "palpable/sources/picture/decoders.hpp"
#include "palpable/sources/picture/exif.hpp"
#include "palpable/sources/picture/file_marks.hpp"
#include "palpable/sources/picture/photo_depth.hpp"
#include "palpable/sources/picture/picture_reply.hpp"

#include <algorithm>
#include <string>

namespace palpable::sources {
namespace {

bool looks_like_pnm(std::span<const std::byte> file) {
  const std::string_view text = as_text(file).substr(0, 3);
  return text.size() == 3 && text[0] == 'P' && text[1] >= '1' && text[1] <= '6' &&
         std::string_view(" \t\r\n#").find(text[2]) != std::string_view::npos;
}

bool looks_like_text(std::span<const std::byte> file) {
  const std::string_view start = as_text(file).substr(0, 512);
  return !start.empty() && std::none_of(start.begin(), start.end(), [](char c) {
    const auto u = static_cast<unsigned char>(c);
    return u < 0x20 && u != '\t' && u != '\n' && u != '\r' && u != '\f';
  });
}

Error unknown_format(std::span<const std::byte> file) {
  if (file.empty()) return invalid_input("is empty");
  if (has_magic(file, "GIF8"))
    return invalid_input("is a GIF picture, which is not supported; save it as PNG");
  if (looks_like_text(file)) return invalid_input("is a text file, not a picture");
  return invalid_input(
      "is not a picture of a kind that is understood (PNG, JPEG, TIFF, WebP, HEIC, OpenEXR, BMP, PGM/PPM, "
      "PFM, TGA)");
}

Result<Image> decode_as(PictureFormat format, FileView file) {
  switch (format) {
    case PictureFormat::png:
      return formats::decode_png(file);
    case PictureFormat::jpeg:
      return formats::decode_jpeg(file);
    case PictureFormat::pfm:
      return formats::decode_pfm(file);
    case PictureFormat::tiff:
      return isolated::decode_tiff(file);
    case PictureFormat::webp:
      return isolated::decode_webp(file);
    case PictureFormat::bmp:
      return decode_bmp(file);
    case PictureFormat::pnm:
      return decode_pnm(file);
    case PictureFormat::tga:
      return decode_tga(file);
    case PictureFormat::exr:
      return isolated::decode_exr(file);
    case PictureFormat::heif:
      return isolated::decode_heif(file);
  }
  return unknown_format(file);
}

Image part(const Image& image, int left, int top, int width, int height) {
  Image out{width, height, image.channels, image.bits, {}};
  const auto row = static_cast<std::size_t>(width) * static_cast<std::size_t>(image.channels);
  out.samples.resize(row * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    std::copy_n(image.pixel(left, top + y), row, out.samples.data() + static_cast<std::size_t>(y) * row);
  return out;
}

}  // namespace

std::optional<PictureFormat> picture_format_of(std::span<const std::byte> file) {
  if (has_magic(file, "\x89PNG\r\n\x1A\n")) return PictureFormat::png;
  if (has_magic(file, "\xFF\xD8\xFF")) return PictureFormat::jpeg;
  if (has_magic(file, std::string_view("II*\0", 4)) || has_magic(file, std::string_view("MM\0*", 4)) ||
      has_magic(file, std::string_view("II+\0", 4)) || has_magic(file, std::string_view("MM\0+", 4)))
    return PictureFormat::tiff;
  if (has_magic(file, "RIFF") && has_magic(file, "WEBP", 8)) return PictureFormat::webp;
  if (is_exr(file)) return PictureFormat::exr;
  if (is_heif(file)) return PictureFormat::heif;
  if (has_magic(file, "BM")) return PictureFormat::bmp;
  if (has_magic(file, "Pf") || has_magic(file, "PF")) return PictureFormat::pfm;
  if (looks_like_pnm(file)) return PictureFormat::pnm;
  if (looks_like_tga(file)) return PictureFormat::tga;
  return std::nullopt;
}

bool is_decoded_in_child(std::span<const std::byte> start) {
  switch (picture_format_of(start).value_or(PictureFormat::png)) {
    case PictureFormat::tiff:
    case PictureFormat::webp:
    case PictureFormat::exr:
    case PictureFormat::heif:
      return true;
    default:
      return false;
  }
}

Result<Image> decode_picture(FileView file) {
  const auto format = picture_format_of(file);
  if (!format) return unknown_format(file);
  auto image = decode_as(*format, file);
  if (!image) return image;
  const bool may_state = *format == PictureFormat::jpeg || *format == PictureFormat::png ||
                         *format == PictureFormat::tiff || *format == PictureFormat::webp;
  return may_state ? upright(*std::move(image), orientation_of(file)) : std::move(image);
}

Result<Image> read_picture(const std::filesystem::path& path) {
  const auto file = read_file_bytes(path, is_decoded_in_child);
  if (!file) return file.error();
  auto image = decode_picture(file->view());
  if (!image) image.error().place = path.string();
  return image;
}

Result<std::pair<Image, Image>> split_side_by_side(const Image& both) {
  if (both.width < 2) return invalid_input("is too narrow to hold two pictures side by side");
  const int half = both.width / 2;
  return std::pair(part(both, 0, 0, half, both.height), part(both, half, 0, half, both.height));
}

Result<std::pair<Image, Image>> split_over_under(const Image& both) {
  if (both.height < 2) return invalid_input("is too low to hold two pictures one above the other");
  const int half = both.height / 2;
  return std::pair(part(both, 0, 0, both.width, half), part(both, 0, half, both.width, half));
}

}  // namespace palpable::sources
