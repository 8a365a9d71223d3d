// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "test_videos.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
}

namespace palpable::test {
namespace {

// What a ray from `from` meets: a box on a table.
double grey_of(Vec3 from, Vec3 direction, FilmedScene scene) {
  const bool other = scene == FilmedScene::other_box;
  const Vec3 most = other ? Vec3{0.04, 0.08, 0.09} : Vec3{0.06, 0.05, 0.06};
  const Vec3 least{-most.x, -most.y, 0.0};
  double begin = 0.0, end = 1e9;
  int axis = 2;
  for (int i = 0; i < 3; ++i) {
    const auto part = [i](const Vec3& p) { return i == 0 ? p.x : i == 1 ? p.y : p.z; };
    const double a = (part(least) - part(from)) / part(direction),
                 b = (part(most) - part(from)) / part(direction);
    if (std::min(a, b) > begin) begin = std::min(a, b), axis = i;
    end = std::min(end, std::max(a, b));
  }
  const bool box = begin < end;
  const Vec3 p = from + (box ? begin : -from.z / direction.z) * direction;
  const double shade = !box || axis == 2 ? 1.0 : axis == 0 ? 0.75 : 0.6;
  const int first = other ? 20 : 0;
  const double level = axis == 0 && box   ? texture_at(p.y, p.z, first + 3)
                       : axis == 1 && box ? texture_at(p.x, p.z, first + 2)
                                          : texture_at(p.x, p.y, first + (box ? 1 : 0));
  return shade * (0.15 + 0.8 * level);
}

// A file that is being written; frees what it owns.
struct Writer {
  AVFormatContext* format = nullptr;
  AVCodecContext* codec = nullptr;
  AVFrame* frame = av_frame_alloc();
  AVPacket* packet = av_packet_alloc();
  AVStream* stream = nullptr;

  Writer() = default;
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() {
    if (format != nullptr) avio_closep(&format->pb);
    avformat_free_context(format);
    avcodec_free_context(&codec);
    av_frame_free(&frame);
    av_packet_free(&packet);
  }

  bool begin(const std::string& file, int width, int height, int turns) {
    avformat_alloc_output_context2(&format, nullptr, "mov", file.c_str());
    const AVCodec* png = avcodec_find_encoder(AV_CODEC_ID_PNG);
    if (format == nullptr || png == nullptr) return false;
    stream = avformat_new_stream(format, nullptr);
    codec = avcodec_alloc_context3(png);
    codec->width = width, codec->height = height, codec->pix_fmt = AV_PIX_FMT_RGB24;
    codec->time_base = stream->time_base = {1, kTicks};
    if (avcodec_open2(codec, png, nullptr) < 0) return false;
    avcodec_parameters_from_context(stream->codecpar, codec);
    if (turns != 0) {
      auto* matrix = reinterpret_cast<std::int32_t*>(
          av_stream_new_side_data(stream, AV_PKT_DATA_DISPLAYMATRIX, 9 * sizeof(std::int32_t)));
      av_display_rotation_set(matrix, -90.0 * turns);
    }
    return avio_open(&format->pb, file.c_str(), AVIO_FLAG_WRITE) >= 0 &&
           avformat_write_header(format, nullptr) >= 0;
  }

  bool add(const Raster<Rgb8>& picture, std::int64_t time) {
    frame->width = picture.width(), frame->height = picture.height(), frame->format = AV_PIX_FMT_RGB24;
    if (frame->data[0] == nullptr && av_frame_get_buffer(frame, 0) < 0) return false;
    for (int y = 0; y < picture.height(); ++y)
      std::memcpy(frame->data[0] + static_cast<std::ptrdiff_t>(y) * frame->linesize[0], picture.row(y).data(),
                  picture.row(y).size_bytes());
    frame->pts = time;
    return avcodec_send_frame(codec, frame) >= 0 && write_packets();
  }

  bool end() {
    return avcodec_send_frame(codec, nullptr) >= 0 && write_packets() && av_write_trailer(format) >= 0;
  }

  static constexpr int kTicks = 600;

 private:
  bool write_packets() {
    while (avcodec_receive_packet(codec, packet) >= 0) {
      // Without it the last picture is shown for no time, and a file of one picture for none at all.
      packet->duration = kTicks / 30;
      av_packet_rescale_ts(packet, codec->time_base, stream->time_base);
      packet->stream_index = stream->index;
      if (av_interleaved_write_frame(format, packet) < 0) return false;
    }
    return true;
  }
};

}  // namespace

double texture_at(double u, double v, int surface) {
  const auto random = [surface](int i, int j) {
    auto h = static_cast<std::uint32_t>(i) * 73856093U ^ static_cast<std::uint32_t>(j) * 19349663U ^
             static_cast<std::uint32_t>(surface) * 83492791U;
    h = (h ^ (h >> 13U)) * 0x5bd1e995U;
    return static_cast<double>((h ^ (h >> 15U)) & 0xFFFFU) / 65535.0;
  };
  double sum = 0.0, weight = 0.0;
  for (const double cell : {0.02, 0.008}) {
    const double x = u / cell + 1000, y = v / cell + 1000;
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const double a = x - i, b = y - j;
    sum += cell * ((1 - b) * ((1 - a) * random(i, j) + a * random(i + 1, j)) +
                   b * ((1 - a) * random(i, j + 1) + a * random(i + 1, j + 1)));
    weight += cell;
  }
  return sum / weight;
}

Raster<Rgb8> picture_from(Vec3 from, Vec3 at, FilmedScene scene) {
  const Vec3 z = unit(at - from), x = unit(cross(z, Vec3{0, 0, 1})), y = cross(z, x);
  Raster<Rgb8> out(kVideoWidth, kVideoHeight);
  for (int v = 0; v < kVideoHeight; ++v)
    for (int u = 0; u < kVideoWidth; ++u) {
      const Vec3 direction = (u - (kVideoWidth - 1) / 2.0) / kVideoFocal_px * x +
                             (v - (kVideoHeight - 1) / 2.0) / kVideoFocal_px * y + z;
      const auto level =
          static_cast<std::uint8_t>(std::lround(255 * std::clamp(grey_of(from, direction, scene), 0.0, 1.0)));
      out(u, v) = {level, static_cast<std::uint8_t>(level * 0.9), static_cast<std::uint8_t>(level * 0.8)};
    }
  return out;
}

Vec3 on_arc(double angle) { return {0.45 * std::sin(angle), -0.45 * std::cos(angle), 0.4}; }

void write_video(const std::string& file, const std::vector<Raster<Rgb8>>& pictures, const FilmedAs& as) {
  Writer writer;
  ASSERT_TRUE(writer.begin(file, pictures.front().width(), pictures.front().height(), as.turns)) << file;
  constexpr std::int64_t kUsual = Writer::kTicks / 30;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    ASSERT_TRUE(
        writer.add(pictures[i], as.times.empty() ? kUsual * static_cast<std::int64_t>(i) : as.times[i]));
  ASSERT_TRUE(writer.end());
}

}  // namespace palpable::test
