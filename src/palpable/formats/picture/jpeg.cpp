// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/picture/jpeg.hpp"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <string>
// After <cstdio>, which libjpeg's header needs.
#include <jerror.h>
#include <jpeglib.h>

namespace palpable::formats {
namespace {

// libjpeg's error handler must not return. Everything with a destructor is in the Job, outside the functions
// that call setjmp.

struct Job {
  jpeg_error_mgr errors{};
  jpeg_progress_mgr progress{};
  jpeg_decompress_struct jpeg{};
  std::jmp_buf jump{};
  std::array<char, JMSG_LENGTH_MAX> message{};
  bool damaged = false;
  std::vector<JSAMPLE> row;
  Image image;

  Job() = default;
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;
  ~Job() { jpeg_destroy_decompress(&jpeg); }
  Error error() const {
    return invalid_input(std::string("is a JPEG picture that is damaged or cut off (") + message.data() +
                         ")");
  }
};

Job& job_of(j_common_ptr jpeg) { return *static_cast<Job*>(jpeg->client_data); }

void keep_message_and_jump(j_common_ptr jpeg) {
  Job& job = job_of(jpeg);
  (*jpeg->err->format_message)(jpeg, job.message.data());
  std::longjmp(job.jump, 1);
}

/// Notes warnings that mean missing or wrong pixels; others (a few stray bytes before a marker) are harmless.
void note_warning(j_common_ptr jpeg, int level) {
  if (level >= 0) return;
  const int code = jpeg->err->msg_code;
  Job& job = job_of(jpeg);
  const bool harmful = code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE ||
                       code == JWRN_MUST_RESYNC;
  if (!harmful || job.damaged) return;
  job.damaged = true;
  (*jpeg->err->format_message)(jpeg, job.message.data());
}

void print_nothing(j_common_ptr) {}

/// Limits the number of scans: a hostile progressive file may have thousands, cameras write about ten.
void refuse_endless_scans(j_common_ptr jpeg) {
  constexpr int kMaxScans = 500;
  if (job_of(jpeg).jpeg.input_scan_number > kMaxScans) ERREXIT(jpeg, JERR_BAD_PROGRESSION);
}

bool read_header(Job& job, std::span<const std::byte> file) {
  job.jpeg.err = jpeg_std_error(&job.errors);
  job.errors.error_exit = keep_message_and_jump;
  job.errors.emit_message = note_warning;
  job.errors.output_message = print_nothing;
  job.jpeg.client_data = &job;
  if (setjmp(job.jump) != 0) return false;
  jpeg_create_decompress(&job.jpeg);
  job.progress.progress_monitor = refuse_endless_scans;
  job.jpeg.progress = &job.progress;
  jpeg_mem_src(&job.jpeg, reinterpret_cast<const unsigned char*>(file.data()), file.size());
  jpeg_read_header(&job.jpeg, TRUE);
  return true;
}

bool start(Job& job) {
  if (setjmp(job.jump) != 0) return false;
  const bool inks = job.jpeg.jpeg_color_space == JCS_CMYK || job.jpeg.jpeg_color_space == JCS_YCCK;
  const bool grey = job.jpeg.jpeg_color_space == JCS_GRAYSCALE;
  job.jpeg.out_color_space = inks ? JCS_CMYK : grey ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_start_decompress(&job.jpeg);
  return true;
}

bool read_row(Job& job) {
  if (setjmp(job.jump) != 0) return false;
  JSAMPROW row = job.row.data();
  jpeg_read_scanlines(&job.jpeg, &row, 1);
  return true;
}

bool finish(Job& job) {
  if (setjmp(job.jump) != 0) return false;
  jpeg_finish_decompress(&job.jpeg);
  return true;
}

/// Adobe writes CMYK inverted (255 = no ink); without Adobe's marker 255 is full ink.
void inks_to_rgb(std::span<const JSAMPLE> inks, bool inverted, float* out) {
  const auto light = [inverted](JSAMPLE v) {
    const float f = static_cast<float>(v) / 255.0F;
    return inverted ? f : 1.0F - f;
  };
  for (std::size_t i = 0; i + 3 < inks.size(); i += 4) {
    const float black = light(inks[i + 3]);
    for (std::size_t c = 0; c < 3; ++c) *out++ = light(inks[i + c]) * black;
  }
}

}  // namespace

Result<Image> decode_jpeg(std::span<const std::byte> file) {
  Job job;
  if (!read_header(job, file)) return job.error();
  if (auto size = check_picture_size(job.jpeg.image_width, job.jpeg.image_height); !size)
    return std::move(size).error();
  if (!start(job)) return job.error();

  Image& image = job.image;
  const int components = job.jpeg.output_components;
  const bool inks = components == 4;
  image.width = static_cast<int>(job.jpeg.output_width);
  image.height = static_cast<int>(job.jpeg.output_height);
  image.channels = inks ? 3 : components;
  const std::size_t row_samples =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
  job.row.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(components));
  image.samples.resize(row_samples * static_cast<std::size_t>(image.height));
  float* out = image.samples.data();
  for (int y = 0; y < image.height && !job.damaged; ++y, out += row_samples) {
    if (!read_row(job)) return job.error();
    if (inks)
      inks_to_rgb(job.row, job.jpeg.saw_Adobe_marker != 0, out);
    else
      std::transform(job.row.begin(), job.row.end(), out,
                     [](JSAMPLE v) { return static_cast<float>(v) / 255.0F; });
  }
  // finish() reads the rest of the file, and may find it damaged without failing.
  if (job.damaged || !finish(job) || job.damaged) return job.error();
  return std::move(job.image);
}

}  // namespace palpable::formats
