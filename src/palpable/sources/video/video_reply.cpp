// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/video/video_reply.hpp"

#include "palpable/sources/isolated/flat.hpp"
#include "palpable/sources/isolated/isolated.hpp"

#include <cstring>

namespace palpable::sources::isolated {
namespace {

struct Header {
  std::int32_t frames = 0, width = 0, height = 0, full_width = 0, full_height = 0, lost = 0;
};
static_assert(sizeof(Rgb8) == 3);

bool is_valid(const Header& header) {
  const auto fits = [](std::int32_t side) { return side >= 1 && side <= kLongestVideoSide; };
  return header.frames >= 1 && header.frames <= 2 * kMostVideoFrames && fits(header.width) &&
         fits(header.height) && header.lost >= 0 &&
         check_picture_size(header.full_width, header.full_height).has_value();
}

}  // namespace

std::vector<std::byte> reply_of(const Video& video) {
  FlatWriter reply;
  begin_value(reply);
  const Raster<Rgb8>& first = video.frames.front().picture;
  reply.put(Header{static_cast<std::int32_t>(video.frames.size()), first.width(), first.height(),
                   video.full_width, video.full_height, video.lost});
  for (const VideoFrame& frame : video.frames) {
    reply.put(static_cast<std::int32_t>(frame.number));
    reply.put_array(frame.picture.values());
  }
  return reply.take();
}

Result<Video> video_in(std::span<const std::byte> reply) {
  FlatReader reader(reply);
  if (auto opened = open_reply(reader); !opened) return opened.error();
  const auto header = reader.get<Header>();
  if (!is_valid(header)) return invalid_reply();
  Video video{{}, header.full_width, header.full_height, header.lost};
  int last = -1;
  for (int i = 0; i < header.frames; ++i) {
    VideoFrame frame{reader.get<std::int32_t>(), Raster<Rgb8>(header.width, header.height)};
    const auto bytes = reader.get_bytes(frame.picture.count() * sizeof(Rgb8));
    if (!reader.ok() || frame.number <= last) return invalid_reply();
    last = frame.number;
    std::memcpy(frame.picture.data(), bytes.data(), bytes.size());
    video.frames.push_back(std::move(frame));
  }
  if (!reader.done()) return invalid_reply();
  return video;
}

Result<Video> decode_video(FileView file) {
  const auto reply = decode(Job::video, file);
  if (!reply) return reply.error();
  return video_in(reply->bytes());
}

}  // namespace palpable::sources::isolated
