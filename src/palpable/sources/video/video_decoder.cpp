// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/video/video_decoder.hpp"

#include "palpable/sources/video/ffmpeg_owned.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

extern "C" {
#include <libavutil/display.h>
#include <libavutil/log.h>
}

namespace palpable::sources {
namespace {

// A file in memory, for FFmpeg's input functions.
struct MemoryFile {
  std::span<const std::byte> bytes;
  std::size_t at = 0;

  static int read(void* self, std::uint8_t* to, int wanted) {
    auto& file = *static_cast<MemoryFile*>(self);
    const std::size_t count =
        std::min(static_cast<std::size_t>(std::max(wanted, 0)), file.bytes.size() - file.at);
    if (count == 0) return AVERROR_EOF;
    std::memcpy(to, file.bytes.data() + file.at, count);
    file.at += count;
    return static_cast<int>(count);
  }
  static std::int64_t seek(void* self, std::int64_t offset, int whence) {
    auto& file = *static_cast<MemoryFile*>(self);
    const auto size = static_cast<std::int64_t>(file.bytes.size());
    if (whence == AVSEEK_SIZE) return size;
    const std::int64_t base = whence == SEEK_CUR   ? static_cast<std::int64_t>(file.at)
                              : whence == SEEK_END ? size
                                                   : 0;
    if (offset < -base || offset > size - base) return AVERROR(EINVAL);
    file.at = static_cast<std::size_t>(base + offset);
    return base + offset;
  }
};

Error damaged(const char* what) { return invalid_input(std::string("is damaged: ") + what); }

// Number of clockwise quarter turns, 0 … 3, that make the frame upright: a phone's rotation flag.
int quarter_turns(const AVStream& stream) {
  const std::uint8_t* matrix = av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr);
  if (matrix == nullptr) return 0;
  const double degrees = av_display_rotation_get(reinterpret_cast<const std::int32_t*>(matrix));
  if (!std::isfinite(degrees)) return 0;
  return ((static_cast<int>(std::lround(-degrees / 90.0)) % 4) + 4) % 4;
}

Raster<Rgb8> turned(const Raster<Rgb8>& picture, int turns) {
  if (turns == 0) return picture;
  const int w = picture.width(), h = picture.height();
  Raster<Rgb8> out(turns == 2 ? w : h, turns == 2 ? h : w);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      if (turns == 1) out(h - 1 - y, x) = picture(x, y);
      if (turns == 2) out(w - 1 - x, h - 1 - y) = picture(x, y);
      if (turns == 3) out(y, w - 1 - x) = picture(x, y);
    }
  return out;
}

class VideoFile {
 public:
  explicit VideoFile(std::span<const std::byte> file) : file_{file} {}

  Result<void> open() {
    av_log_set_level(AV_LOG_QUIET);
    constexpr int kBuffer = 1 << 16;
    io_.reset(avio_alloc_context(static_cast<std::uint8_t*>(av_malloc(kBuffer)), kBuffer, 0, &file_,
                                 MemoryFile::read, nullptr, MemoryFile::seek));
    AVFormatContext* format = avformat_alloc_context();
    format->pb = io_.get();
    if (avformat_open_input(&format, nullptr, nullptr, nullptr) < 0)
      return damaged("it is not a readable video");
    format_.reset(format);
    if (avformat_find_stream_info(format, nullptr) < 0) return damaged("its streams are not described");
    const AVCodec* codec = nullptr;
    stream_ = av_find_best_stream(format, AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
    if (stream_ < 0 || codec == nullptr) return invalid_input("holds no pictures");
    codec_.reset(avcodec_alloc_context3(codec));
    const AVStream& stream = *format->streams[stream_];
    if (avcodec_parameters_to_context(codec_.get(), stream.codecpar) < 0)
      return damaged("its codec is not described");
    codec_->thread_count = 2;
    if (avcodec_open2(codec_.get(), codec, nullptr) < 0)
      return invalid_input("uses a codec that cannot be read");
    turns_ = quarter_turns(stream);
    return {};
  }

  // Approximate number of frames: as stated, or from duration and rate.
  double stated_frames() const {
    const AVStream& stream = *format_->streams[stream_];
    if (stream.nb_frames > 0) return static_cast<double>(stream.nb_frames);
    const double seconds = static_cast<double>(format_->duration) / AV_TIME_BASE;
    return std::max(
        0.0, seconds * av_q2d(stream.avg_frame_rate.den > 0 ? stream.avg_frame_rate : AVRational{30, 1}));
  }

  Result<Video> read() {
    step_ = std::max(1, static_cast<int>(std::ceil(std::min(stated_frames(), 1e6) / kMostVideoFrames)));
    const ffmpeg::Packet packet(av_packet_alloc());
    while (av_read_frame(format_.get(), packet.get()) >= 0 && !full()) {
      if (packet->stream_index == stream_ && (packet->flags & AV_PKT_FLAG_DISCARD) != 0) ++hidden_;
      if (packet->stream_index == stream_ && avcodec_send_packet(codec_.get(), packet.get()) == 0)
        if (auto taken = take_frames(); !taken) return taken.error();
      av_packet_unref(packet.get());
    }
    if (avcodec_send_packet(codec_.get(), nullptr) == 0)
      if (auto taken = take_frames(); !taken) return taken.error();
    if (video_.frames.empty()) return damaged("none of its frames can be read");
    // Some programs state one frame too many.
    const std::int64_t stated = std::min(frames_to_show(), kMostStated) - hidden_;
    if (!full() && number_ + 1 < stated) video_.lost += static_cast<int>(stated) - number_;
    return std::move(video_);
  }

 private:
  static constexpr std::int64_t kMostStated = 1000000;

  // The frames that the file states, without those that it was trimmed by: an edit list hides them, and
  // FFmpeg leaves them out of its index, or marks their packets to be discarded.
  std::int64_t frames_to_show() const {
    const AVStream& stream = *format_->streams[stream_];
    const bool has_edits = std::strstr(format_->iformat->name, "mp4") != nullptr;
    return has_edits ? avformat_index_get_entries_count(&stream) : stream.nb_frames;
  }

  // If a file states fewer frames than it has, at most twice the limit is kept.
  bool full() const { return video_.frames.size() >= 2 * static_cast<std::size_t>(kMostVideoFrames); }

  // FFmpeg fills damaged parts of a frame with those of others.
  static bool is_damaged(const AVFrame& frame) {
    return (frame.flags & AV_FRAME_FLAG_CORRUPT) != 0 || frame.decode_error_flags != 0;
  }

  Result<void> take_frames() {
    const ffmpeg::Frame frame(av_frame_alloc());
    for (; !full() && avcodec_receive_frame(codec_.get(), frame.get()) == 0; ++number_)
      if (is_damaged(*frame))
        ++video_.lost;
      else if (number_ % step_ == 0)
        if (auto kept = keep(*frame); !kept) return kept;
    return {};
  }

  Result<void> keep(const AVFrame& frame) {
    if (auto good = check_picture_size(frame.width, frame.height); !good) return good;
    if (video_.full_width == 0) begin_scaling(frame);
    if (frame.width != width_ || frame.height != height_ || frame.format != format_of_frames_ || !scaler_)
      return damaged("the size of its frames changes");
    Raster<Rgb8> picture(scaled_width_, scaled_height_);
    constexpr int kAlign = ffmpeg::kBeyondRow;
    const int stride = (3 * scaled_width_ + kAlign - 1) / kAlign * kAlign;
    rows_.resize(static_cast<std::size_t>(stride) * static_cast<std::size_t>(scaled_height_) + kAlign);
    ffmpeg::scale_to_rows(scaler_.get(), frame, rows_.data(), stride);
    for (int y = 0; y < scaled_height_; ++y)
      std::memcpy(picture.row(y).data(),
                  rows_.data() + static_cast<std::size_t>(stride) * static_cast<std::size_t>(y),
                  picture.row(y).size_bytes());
    video_.frames.push_back({number_, turned(picture, turns_)});
    return {};
  }

  void begin_scaling(const AVFrame& frame) {
    width_ = frame.width, height_ = frame.height, format_of_frames_ = frame.format;
    const double scale = std::min(1.0, static_cast<double>(kLongestVideoSide) / std::max(width_, height_));
    scaled_width_ = std::max(1, static_cast<int>(std::lround(scale * width_)));
    scaled_height_ = std::max(1, static_cast<int>(std::lround(scale * height_)));
    scaler_.reset(sws_getContext(
        width_, height_, static_cast<AVPixelFormat>(frame.format), scaled_width_, scaled_height_,
        AV_PIX_FMT_RGB24, SWS_AREA | SWS_FULL_CHR_H_INT | SWS_ACCURATE_RND, nullptr, nullptr, nullptr));
    const bool is_turned = turns_ % 2 == 1;
    video_.full_width = is_turned ? height_ : width_;
    video_.full_height = is_turned ? width_ : height_;
  }

  MemoryFile file_;
  ffmpeg::Io io_;
  ffmpeg::Format format_;
  ffmpeg::Codec codec_;
  ffmpeg::Scaler scaler_;
  std::vector<std::uint8_t> rows_;
  int stream_ = -1;
  int turns_ = 0;
  int step_ = 1;
  int number_ = 0;
  // Packets of trimmed frames, which are decoded because later frames need them.
  int hidden_ = 0;
  int width_ = 0, height_ = 0, format_of_frames_ = 0;
  int scaled_width_ = 0, scaled_height_ = 0;
  Video video_;
};

}  // namespace

Result<Video> decode_video(std::span<const std::byte> file) {
  VideoFile video(file);
  if (auto opened = video.open(); !opened) return opened.error();
  return video.read();
}

}  // namespace palpable::sources
