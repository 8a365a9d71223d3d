// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/sources/picture/decoders.hpp"

#include <algorithm>
#include <optional>

namespace palpable::sources {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }

/// The text part of a file: numbers separated by white space and comments.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// The next whole number up to `most`; nullopt at the end or at anything else.
  std::optional<int> number(int most) {
    skip_blanks();
    if (text_.empty() || text_.front() < '0' || text_.front() > '9') return std::nullopt;
    std::int64_t value = 0;
    while (!text_.empty() && text_.front() >= '0' && text_.front() <= '9') {
      value = 10 * value + (text_.front() - '0');
      if (value > most) return std::nullopt;
      text_.remove_prefix(1);
    }
    return static_cast<int>(value);
  }
  /// The digits of P1 need not be separated.
  std::optional<int> bit() {
    skip_blanks();
    if (text_.empty() || (text_.front() != '0' && text_.front() != '1')) return std::nullopt;
    const int value = text_.front() - '0';
    text_.remove_prefix(1);
    return value;
  }
  /// The bytes after the single white space that ends the header.
  std::string_view rest() const { return text_.empty() ? text_ : text_.substr(1); }

 private:
  void skip_blanks() {
    while (!text_.empty() && (is_blank(text_.front()) || text_.front() == '#')) {
      if (text_.front() == '#')
        text_.remove_prefix(std::min(text_.find('\n'), text_.size()));
      else
        text_.remove_prefix(1);
    }
  }
  std::string_view text_;
};

/// Decimal text: P1, P2, P3.
bool read_digits(Words& words, bool bits, int most, std::vector<float>& samples) {
  for (float& sample : samples) {
    const auto value = bits ? words.bit() : words.number(most);
    if (!value) return false;
    sample = bits ? static_cast<float>(1 - *value) : static_cast<float>(*value) / static_cast<float>(most);
  }
  return true;
}

/// P4: one bit a pixel, rows padded to whole bytes, 1 = black.
bool read_packed_bits(std::string_view raw, Image& image) {
  const auto width = static_cast<std::size_t>(image.width);
  const std::size_t row = (width + 7) / 8;
  if (raw.size() < row * static_cast<std::size_t>(image.height)) return false;
  for (std::size_t i = 0; i < image.samples.size(); ++i) {
    const auto byte = static_cast<unsigned char>(raw[i / width * row + i % width / 8]);
    image.samples[i] = ((byte >> (7 - i % width % 8)) & 1U) != 0U ? 0.0F : 1.0F;
  }
  return true;
}

/// P5, P6: one byte a sample, or two with the high one first.
bool read_binary(std::string_view raw, int most, std::vector<float>& samples) {
  const bool wide = most > 255;
  if (raw.size() < samples.size() * (wide ? 2 : 1)) return false;
  ByteReader reader(as_bytes(raw), std::endian::big);
  for (float& sample : samples)
    sample =
        static_cast<float>(std::min<int>(wide ? reader.u16() : reader.u8(), most)) / static_cast<float>(most);
  return true;
}

}  // namespace

Result<Image> decode_pnm(std::span<const std::byte> file) {
  const Error damaged_header = invalid_input("is a PBM, PGM or PPM picture with a damaged header");
  const std::string_view text = as_text(file);
  if (text.size() < 3 || text[0] != 'P' || text[1] < '1' || text[1] > '6') return damaged_header;
  const int kind = text[1] - '0';
  const bool bits = kind == 1 || kind == 4;
  Words words(text.substr(2));
  constexpr int kMaxSide = 1 << 30;
  const auto width = words.number(kMaxSide);
  const auto height = words.number(kMaxSide);
  const auto most = bits ? std::optional(1) : words.number(65535);
  if (!width || !height || !most || *most == 0) return damaged_header;
  if (auto size = check_picture_size(*width, *height); !size) return std::move(size).error();

  Image image{*width, *height, kind == 3 || kind == 6 ? 3 : 1, *most > 255 ? 16 : 8, {}};
  const auto count = static_cast<std::size_t>(*width) * static_cast<std::size_t>(*height) *
                     static_cast<std::size_t>(image.channels);
  const bool digits = kind <= 3;
  // At most eight pixels per byte, so a header alone cannot cause a large allocation.
  if (words.rest().size() < count / 8) return invalid_input("is cut off: pixels are missing");
  image.samples.resize(count);
  const bool whole = digits ? read_digits(words, bits, *most, image.samples)
                     : bits ? read_packed_bits(words.rest(), image)
                            : read_binary(words.rest(), *most, image.samples);
  if (!whole) return invalid_input("is cut off or damaged: pixels are missing or out of range");
  return image;
}

}  // namespace palpable::sources
