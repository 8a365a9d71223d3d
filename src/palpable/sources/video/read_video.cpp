// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/video/read_video.hpp"

#include "palpable/core/files/file_bytes.hpp"
#include "palpable/sources/picture/exif.hpp"
#include "palpable/sources/picture/picture.hpp"
#include "palpable/sources/video/video_reply.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace palpable::sources {
namespace {

Raster<Rgb8> reduced_to_side(const Raster<Rgb8>& picture, int longest) {
  const double scale = static_cast<double>(longest) / std::max(picture.width(), picture.height());
  if (scale >= 1.0) return picture;
  Raster<Rgb8> out(std::max(1, static_cast<int>(std::lround(scale * picture.width()))),
                   std::max(1, static_cast<int>(std::lround(scale * picture.height()))));
  const cv::Mat from(picture.height(), picture.width(), CV_8UC3, const_cast<Rgb8*>(picture.data()));
  cv::Mat to(out.height(), out.width(), CV_8UC3, out.data());
  cv::resize(from, to, to.size(), 0, 0, cv::INTER_AREA);
  return out;
}

// The first picture decides the size, and states the focal length.
Result<void> add_picture(Video& video, const std::filesystem::path& file, int index, const Image& image) {
  if (video.frames.empty()) {
    video.full_width = image.width, video.full_height = image.height;
    if (const auto bytes = read_file(file)) video.focal_length_35mm = focal_length_35mm(*bytes);
  }
  if (image.width != video.full_width || image.height != video.full_height)
    return invalid_input(
        "has another size than the pictures before it; one camera takes pictures of one size", file.string());
  video.frames.push_back({index, reduced_to_side(rgb8(image), kLongestVideoSide)});
  return {};
}

Result<Video> read_pictures(std::span<const std::filesystem::path> files, const Work& work) {
  Video video;
  const std::size_t step = (files.size() + kMostVideoFrames - 1) / kMostVideoFrames;
  for (std::size_t i = 0; i < files.size(); i += step) {
    if (work.cancelled()) return Work::interrupted();
    work.report(static_cast<double>(i) / static_cast<double>(files.size()), "reading the pictures");
    const auto image = read_picture(files[i]);
    if (image) {
      if (auto added = add_picture(video, files[i], static_cast<int>(i), *image); !added)
        return added.error();
    } else {
      ++video.lost;
      if (!video.first_lost) video.first_lost = image.error();
    }
  }
  if (video.frames.empty()) return *video.first_lost;
  return video;
}

}  // namespace

Result<Video> read_video(std::span<const std::filesystem::path> files, const Work& work) {
  if (files.size() != 1) return read_pictures(files, work);
  work.report(0.0, "reading the video");
  const auto bytes = read_file_bytes(files.front(), [](std::span<const std::byte>) { return true; });
  if (!bytes) return bytes.error();
  auto video = isolated::decode_video(bytes->view());
  if (!video)
    return Error{video.error().code, video.error().message, files.front().string(), video.error().reason};
  return video;
}

}  // namespace palpable::sources
