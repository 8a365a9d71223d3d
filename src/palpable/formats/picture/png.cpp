// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/picture/png.hpp"

#include "palpable/core/files/byte_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <string>

#include <png.h>

namespace palpable::formats {
namespace {

// libpng reports errors by longjmp. Everything with a destructor is in a job outside the functions that call
// setjmp, so the jump skips no destructor.

struct Message {
  std::array<char, 160> text{};
};

void keep_message_and_jump(png_structp png, png_const_charp text) {
  auto* message = static_cast<Message*>(png_get_error_ptr(png));
  std::strncpy(message->text.data(), text, message->text.size() - 1);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

struct ReadJob {
  explicit ReadJob(std::span<const std::byte> file) : bytes(file) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &message, keep_message_and_jump, ignore_warning);
    if (png != nullptr) info = png_create_info_struct(png);
  }
  ReadJob(const ReadJob&) = delete;
  ReadJob& operator=(const ReadJob&) = delete;
  ~ReadJob() { png_destroy_read_struct(&png, &info, nullptr); }
  Error error() const {
    return invalid_input(std::string("is a PNG picture that is damaged or cut off (") + message.text.data() +
                         ")");
  }

  ByteReader bytes;
  Message message;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::vector<png_byte> raw;
  std::vector<png_bytep> rows;
};

void take_bytes(png_structp png, png_bytep out, std::size_t count) {
  auto* job = static_cast<ReadJob*>(png_get_io_ptr(png));
  const auto bytes = job->bytes.bytes(count);
  if (!job->bytes.ok()) png_error(png, "the file ends too early");
  std::memcpy(out, bytes.data(), count);
}

bool read_header(ReadJob& job) {
  if (setjmp(png_jmpbuf(job.png)) != 0) return false;
  png_set_read_fn(job.png, &job, take_bytes);
  png_read_info(job.png, job.info);
  return true;
}

bool choose_plain_samples(ReadJob& job) {
  if (setjmp(png_jmpbuf(job.png)) != 0) return false;
  png_set_expand(job.png);
  png_set_interlace_handling(job.png);
  png_read_update_info(job.png, job.info);
  return true;
}

bool read_rows(ReadJob& job) {
  if (setjmp(png_jmpbuf(job.png)) != 0) return false;
  png_read_image(job.png, job.rows.data());
  png_read_end(job.png, nullptr);
  return true;
}

void convert_row(const png_byte* raw, int bits, std::span<float> out) {
  if (bits == 8) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<float>(raw[i]) / 255.0F;
  } else {
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = static_cast<float>((raw[2 * i] << 8) | raw[2 * i + 1]) / 65535.0F;
  }
}

struct WriteJob {
  WriteJob() {
    png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, keep_message_and_jump, ignore_warning);
    if (png != nullptr) info = png_create_info_struct(png);
  }
  WriteJob(const WriteJob&) = delete;
  WriteJob& operator=(const WriteJob&) = delete;
  ~WriteJob() { png_destroy_write_struct(&png, &info); }

  Message message;
  png_structp png = nullptr;
  png_infop info = nullptr;
  int width = 0;
  int height = 0;
  int channels = 1;
  int bits = 8;
  /// Row-major, 16-bit samples with the high byte first.
  std::vector<png_byte> raw;
  std::vector<std::byte> file;

  std::size_t row_bytes() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels * bits / 8);
  }
};

void give_bytes(png_structp png, png_bytep bytes, std::size_t count) {
  auto* job = static_cast<WriteJob*>(png_get_io_ptr(png));
  const auto* begin = reinterpret_cast<const std::byte*>(bytes);
  job->file.insert(job->file.end(), begin, begin + count);
}

void flush_nothing(png_structp) {}

bool write_all(WriteJob& job) {
  static constexpr std::array<int, 5> kColourType{0, PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                                  PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};
  if (setjmp(png_jmpbuf(job.png)) != 0) return false;
  png_set_write_fn(job.png, &job, give_bytes, flush_nothing);
  png_set_IHDR(job.png, job.info, static_cast<png_uint_32>(job.width), static_cast<png_uint_32>(job.height),
               job.bits, kColourType[static_cast<std::size_t>(job.channels)], PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(job.png, job.info);
  for (int y = 0; y < job.height; ++y)
    png_write_row(job.png, job.raw.data() + static_cast<std::size_t>(y) * job.row_bytes());
  png_write_end(job.png, nullptr);
  return true;
}

Result<std::vector<std::byte>> encode(WriteJob& job) {
  if (job.png == nullptr || job.info == nullptr) return Error{ErrorCode::failed, "out of memory", {}};
  if (!write_all(job))
    return Error{ErrorCode::failed, std::string("cannot be made a PNG: ") + job.message.text.data(), {}};
  return std::move(job.file);
}

void append_16(std::vector<png_byte>& raw, std::uint16_t value) {
  raw.push_back(static_cast<png_byte>(value >> 8U));
  raw.push_back(static_cast<png_byte>(value & 0xFFU));
}

}  // namespace

std::uint64_t pixels_of_png(std::span<const std::byte> file) {
  // The signature, the length and name of the first chunk, then both sizes, the most significant byte first.
  constexpr std::size_t kSignature = 8, kWidth = 16, kHeight = 20, kEnd = 24;
  if (file.size() < kEnd || png_sig_cmp(reinterpret_cast<png_const_bytep>(file.data()), 0, kSignature) != 0)
    return 0;
  const auto number_at = [&](std::size_t at) {
    std::uint64_t number = 0;
    for (const std::byte byte : file.subspan(at, 4)) number = number << 8U | std::to_integer<unsigned>(byte);
    return number;
  };
  return number_at(kWidth) * number_at(kHeight);
}

Result<Image> decode_png(std::span<const std::byte> file) {
  ReadJob job(file);
  if (job.png == nullptr || job.info == nullptr) return Error{ErrorCode::failed, "out of memory", {}};
  if (!read_header(job)) return job.error();
  const auto width = png_get_image_width(job.png, job.info);
  const auto height = png_get_image_height(job.png, job.info);
  if (auto size = check_picture_size(width, height); !size) return std::move(size).error();
  if (!choose_plain_samples(job)) return job.error();

  Image image;
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  image.channels = png_get_channels(job.png, job.info);
  image.bits = png_get_bit_depth(job.png, job.info);
  const std::size_t row_bytes = png_get_rowbytes(job.png, job.info);
  const std::size_t row_samples = static_cast<std::size_t>(width) * static_cast<std::size_t>(image.channels);
  job.raw.resize(row_bytes * height);
  for (std::size_t y = 0; y < height; ++y) job.rows.push_back(job.raw.data() + y * row_bytes);
  if (!read_rows(job)) return job.error();
  image.samples.resize(row_samples * height);
  for (std::size_t y = 0; y < height; ++y)
    convert_row(job.rows[y], image.bits, std::span(image.samples).subspan(y * row_samples, row_samples));
  return image;
}

Result<std::vector<std::byte>> encode_png(const Raster<Rgb8>& picture) {
  WriteJob job;
  job.width = picture.width();
  job.height = picture.height();
  job.channels = 3;
  job.raw.reserve(3 * picture.count());
  for (const Rgb8 p : picture.values()) job.raw.insert(job.raw.end(), {p.r, p.g, p.b});
  return encode(job);
}

Result<std::vector<std::byte>> encode_png(const Raster<std::uint8_t>& grey) {
  WriteJob job;
  job.width = grey.width();
  job.height = grey.height();
  job.raw.assign(grey.values().begin(), grey.values().end());
  return encode(job);
}

Result<std::vector<std::byte>> encode_png(const Raster<std::uint16_t>& grey) {
  WriteJob job;
  job.width = grey.width();
  job.height = grey.height();
  job.bits = 16;
  job.raw.reserve(2 * grey.count());
  for (const std::uint16_t v : grey.values()) append_16(job.raw, v);
  return encode(job);
}

Result<std::vector<std::byte>> encode_png(const Image& picture) {
  PALPABLE_CHECK(picture.channels >= 1 && picture.channels <= 4);
  WriteJob job;
  job.width = picture.width;
  job.height = picture.height;
  job.channels = picture.channels;
  job.bits = picture.bits > 8 ? 16 : 8;
  job.raw.reserve(job.row_bytes() * static_cast<std::size_t>(picture.height));
  const float most = job.bits == 16 ? 65535.0F : 255.0F;
  for (const float v : picture.samples) {
    const auto value =
        static_cast<std::uint16_t>(std::lround(most * std::clamp(std::isfinite(v) ? v : 0.0F, 0.0F, 1.0F)));
    if (job.bits == 16)
      append_16(job.raw, value);
    else
      job.raw.push_back(static_cast<png_byte>(value));
  }
  return encode(job);
}

}  // namespace palpable::formats
