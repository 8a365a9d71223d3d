// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/picture/jpeg_encoder.hpp"

#include <csetjmp>
#include <cstdio>
#include <cstdlib>
// After <cstdio>, which libjpeg's header needs.
#include <jpeglib.h>

namespace palpable::formats {
namespace {

/// Everything that outlives a jump out of libjpeg, whose error handler must not return.
struct JpegWriter {
  jpeg_error_mgr errors{};
  jpeg_compress_struct jpeg{};
  std::jmp_buf jump{};
  unsigned char* bytes = nullptr;
  unsigned long size = 0;

  JpegWriter() = default;
  JpegWriter(const JpegWriter&) = delete;
  JpegWriter& operator=(const JpegWriter&) = delete;
  ~JpegWriter() {
    jpeg_destroy_compress(&jpeg);
    std::free(bytes);
  }
};

void jump_out(j_common_ptr jpeg) { std::longjmp(static_cast<JpegWriter*>(jpeg->client_data)->jump, 1); }
void stay_silent(j_common_ptr) {}

/// False if libjpeg has given up. Nothing with a destructor lives here.
bool write_picture(JpegWriter& writer, const Raster<Rgb8>& picture, int quality) {
  static_assert(sizeof(Rgb8) == 3);
  jpeg_compress_struct& jpeg = writer.jpeg;
  jpeg.err = jpeg_std_error(&writer.errors);
  writer.errors.error_exit = jump_out;
  writer.errors.output_message = stay_silent;
  jpeg.client_data = &writer;
  if (setjmp(writer.jump) != 0) return false;
  jpeg_create_compress(&jpeg);
  jpeg_mem_dest(&jpeg, &writer.bytes, &writer.size);
  jpeg.image_width = static_cast<JDIMENSION>(picture.width());
  jpeg.image_height = static_cast<JDIMENSION>(picture.height());
  jpeg.input_components = 3;
  jpeg.in_color_space = JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, quality, TRUE);
  jpeg.optimize_coding = TRUE;
  jpeg_start_compress(&jpeg, TRUE);
  while (jpeg.next_scanline < jpeg.image_height) {
    const Rgb8* const pixels = picture.row(static_cast<int>(jpeg.next_scanline)).data();
    // libjpeg reads the row, though its interface does not say so.
    auto* row = reinterpret_cast<JSAMPROW>(const_cast<Rgb8*>(pixels));
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  return true;
}

}  // namespace

Result<std::vector<std::byte>> encode_jpeg(const Raster<Rgb8>& picture, int quality) {
  JpegWriter writer;
  if (picture.empty() || !write_picture(writer, picture, quality))
    return Error{ErrorCode::failed, "the picture cannot be written as JPEG", {}};
  const auto* const first = reinterpret_cast<const std::byte*>(writer.bytes);
  return std::vector<std::byte>(first, first + writer.size);
}

}  // namespace palpable::formats
