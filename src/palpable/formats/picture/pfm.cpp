// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/picture/pfm.hpp"

#include "palpable/core/files/byte_reader.hpp"

#include <bit>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

namespace palpable::formats {
namespace {

constexpr std::string_view kBlank = " \t\r\n";

/// Takes the next word of a header; `text` then begins with the single blank after it.
std::string_view next_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kBlank));
  text.remove_prefix(word.size());
  return word;
}

template <class T>
std::optional<T> number(std::string_view word) {
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace

Result<Image> decode_pfm(std::span<const std::byte> file) {
  std::string_view text = as_text(file);
  const std::string_view kind = next_word(text);
  const auto width = number<std::int64_t>(next_word(text));
  const auto height = number<std::int64_t>(next_word(text));
  const auto scale = number<double>(next_word(text));
  if ((kind != "Pf" && kind != "PF") || !width || !height || !scale || *scale == 0.0 ||
      !std::isfinite(*scale) || text.empty())
    return invalid_input("is a PFM file with a damaged header");
  if (auto size = check_picture_size(*width, *height); !size) return std::move(size).error();
  text.remove_prefix(1);

  Image image;
  image.width = static_cast<int>(*width);
  image.height = static_cast<int>(*height);
  image.channels = kind == "PF" ? 3 : 1;
  image.bits = 32;
  const std::size_t row = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
  const std::size_t wanted = row * static_cast<std::size_t>(image.height) * sizeof(float);
  if (text.size() < wanted)
    return invalid_input("is cut off: " + std::to_string(text.size()) + " of its " + std::to_string(wanted) +
                         " bytes of pixels are there");
  ByteReader reader(as_bytes(text), *scale < 0.0 ? std::endian::little : std::endian::big);
  image.samples.resize(wanted / sizeof(float));
  for (std::size_t y = static_cast<std::size_t>(image.height); y-- > 0;)
    for (std::size_t i = 0; i < row; ++i) image.samples[y * row + i] = reader.f32();
  return image;
}

std::vector<std::byte> encode_pfm(const Raster<float>& values) {
  static_assert(std::endian::native == std::endian::little);
  const std::string header =
      "Pf\n" + std::to_string(values.width()) + " " + std::to_string(values.height()) + "\n-1.0\n";
  std::vector<std::byte> file;
  file.reserve(header.size() + sizeof(float) * values.count());
  const auto append = [&file](std::span<const std::byte> bytes) {
    file.insert(file.end(), bytes.begin(), bytes.end());
  };
  append(as_bytes(header));
  for (int y = values.height() - 1; y >= 0; --y) append(std::as_bytes(values.row(y)));
  return file;
}

}  // namespace palpable::formats
