// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/stream/stream_reader.hpp"

#include "palpable/sources/live/frame_size.hpp"
#include "palpable/sources/video/ffmpeg_owned.hpp"

#include <array>
#include <chrono>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

extern "C" {
#include <libavutil/log.h>
#include <libavutil/opt.h>
}

namespace palpable::sources::stream {
namespace {

using Clock = std::chrono::steady_clock;

/// Until the first data, and between data.
constexpr std::chrono::seconds kOpening{8}, kSilence{5};

/// FFmpeg's options, which it takes those from that it knows.
class Options {
 public:
  Options() = default;
  Options(const Options&) = delete;
  Options& operator=(const Options&) = delete;
  ~Options() { av_dict_free(&entries_); }
  void set(const char* name, const char* value) { av_dict_set(&entries_, name, value, 0); }
  AVDictionary** entries() { return &entries_; }

 private:
  AVDictionary* entries_ = nullptr;
};

std::string silent_for(std::chrono::seconds time) {
  return fmt::format("has sent nothing for {} s", time.count());
}

/// What FFmpeg said last of a fault; its codes do not tell a host that is unknown from a certificate that is
/// refused.
class LastWords {
 public:
  static void listen() {
    av_log_set_level(AV_LOG_ERROR);
    av_log_set_callback([](void*, int level, const char* format, va_list arguments) {
      if (level > AV_LOG_ERROR) return;
      std::array<char, 300> text{};
      std::vsnprintf(text.data(), text.size(), format, arguments);
      words() = text.data();
    });
  }
  static bool have(std::string_view part) { return words().find(part) != std::string::npos; }
  /// The reason in "Connection to … failed: REASON"; empty: it said no such thing.
  static std::string unreachable() {
    constexpr std::string_view kBefore = " failed: ";
    const auto at = words().find(kBefore);
    if (!words().starts_with("Connection to ") || at == std::string::npos) return {};
    const auto reason = words().substr(at + kBefore.size());
    return reason.substr(0, reason.find('\n'));
  }

 private:
  // FFmpeg's callback gets nothing of ours.
  static std::string& words() {
    thread_local std::string kept;
    return kept;
  }
};

/// Why FFmpeg could not connect.
std::string refusal(int code, bool is_encrypted) {
  if (const auto reason = LastWords::unreachable(); !reason.empty()) return "cannot be reached: " + reason;
  if (LastWords::have("resolve")) return "cannot be found: no host of this name is known";
  if (LastWords::have("certificate"))
    return "has a certificate that this machine does not trust for this name (#certificate=any takes any)";
  switch (code) {
    case AVERROR_HTTP_UNAUTHORIZED:
    case AVERROR_HTTP_FORBIDDEN:
      return "refuses the name and password, or asks for them: NAME:PASSWORD@ before the host";
    case AVERROR_HTTP_NOT_FOUND:
      return "has no such stream";
    case AVERROR_INVALIDDATA:
      return "sends no stream that can be read";
    case AVERROR_PROTOCOL_NOT_FOUND:
    case AVERROR_DEMUXER_NOT_FOUND:
      return "sends a kind of stream that is not read here";
    case AVERROR_HTTP_BAD_REQUEST:
    case AVERROR_HTTP_OTHER_4XX:
    case AVERROR_HTTP_SERVER_ERROR:
      return "answers with an error of its own";
    default:
      break;
  }
  if (is_encrypted && code == AVERROR(EIO)) return "cannot be reached: it speaks no TLS";
  std::vector<char> reason(AV_ERROR_MAX_STRING_SIZE);
  av_strerror(code, reason.data(), reason.size());
  return fmt::format("cannot be reached: {}", reason.data());
}

class Stream {
 public:
  explicit Stream(StreamTaker& taker) : taker_(taker) {}

  /// Why it cannot be read; empty: it is open.
  std::string open(const std::string& url, bool takes_any_certificate) {
    LastWords::listen();
    avformat_network_init();
    AVFormatContext* format = avformat_alloc_context();
    format->interrupt_callback = {is_to_end, this};
    format->flags |= AVFMT_FLAG_NOBUFFER;
    Options options;
    options.set("protocol_whitelist", "rtsp,rtsps,rtp,udp,https,httpproxy,tls,tcp");
    options.set("format_whitelist", "rtsp,mpjpeg,mjpeg,mpegts");
    // RTP within the connection of RTSP, or else by UDP.
    options.set("rtsp_flags", "prefer_tcp");
    options.set("allowed_media_types", "video");
    options.set("timeout", std::to_string(std::chrono::microseconds(kSilence).count()).c_str());
    // Microseconds that are looked at before the first picture.
    options.set("analyzeduration", "500000");
    options.set("fpsprobesize", "0");
    options.set("tls_verify", takes_any_certificate ? "0" : "1");
    if (const char* authorities = std::getenv("SSL_CERT_FILE"); authorities != nullptr)
      options.set("ca_file", authorities);
    const auto begin = Clock::now();
    url_ = url;
    begin_waiting(kOpening);
    const bool is_encrypted = !url.starts_with("rtsp:");
    // It is freed by avformat_open_input() if that fails.
    opening_ = format;
    const int code = avformat_open_input(&format, url.c_str(), nullptr, options.entries());
    opening_ = nullptr;
    if (is_redirected_) return "leads to another address, which is not followed";
    if (code < 0)
      // FFmpeg has no code of its own for an answer that did not come within `timeout`.
      return Clock::now() - begin >= kSilence ? silent_for(kSilence) : refusal(code, is_encrypted);
    format_.reset(format);
    if (is_encrypted && leads_elsewhere()) return "leads to an address without TLS";
    if (avformat_find_stream_info(format, nullptr) < 0)
      return is_late() ? silent_for(kOpening) : "sends no stream that can be read";
    return open_codec();
  }

  /// Why it ended.
  std::string read() {
    const ffmpeg::Packet packet(av_packet_alloc());
    const ffmpeg::Frame frame(av_frame_alloc());
    for (;;) {
      begin_waiting(kSilence);
      const int code = av_read_frame(format_.get(), packet.get());
      // At a time-out FFmpeg first gives what its parser held back, and would wait as long again.
      if (is_late() || code == AVERROR(ETIMEDOUT)) return silent_for(kSilence);
      if (code < 0) return "has ended the stream";
      const auto arrival = Clock::now();
      if (packet->stream_index == stream_ && avcodec_send_packet(codec_.get(), packet.get()) >= 0)
        while (avcodec_receive_frame(codec_.get(), frame.get()) == 0)
          if (auto end = give(*frame, arrival); !end.empty()) return end;
      av_packet_unref(packet.get());
    }
  }

 private:
  static int is_to_end(void* self) {
    auto& stream = *static_cast<Stream*>(self);
    // Asked while a connection is opened, so before a redirection's target gets the password.
    if (stream.opening_ != nullptr && stream.opening_->url != nullptr && stream.url_ != stream.opening_->url)
      stream.is_redirected_ = true;
    return stream.is_redirected_ || stream.is_late() || !stream.taker_.is_there() ? 1 : 0;
  }
  bool is_late() const { return Clock::now() > latest_; }
  void begin_waiting(std::chrono::seconds time) { latest_ = Clock::now() + time; }

  bool leads_elsewhere() const {
    std::uint8_t* location = nullptr;
    if (format_->pb == nullptr || av_opt_get(format_->pb, "location", AV_OPT_SEARCH_CHILDREN, &location) < 0)
      return false;
    const std::string to(location == nullptr ? "" : reinterpret_cast<const char*>(location));
    av_free(location);
    return to.starts_with("http:");
  }

  std::string open_codec() {
    const AVCodec* codec = nullptr;
    stream_ = av_find_best_stream(format_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
    if (stream_ < 0 || codec == nullptr) return "sends no video that can be read";
    const AVCodecParameters& stated = *format_->streams[stream_]->codecpar;
    if (stated.width > 0 && stated.height > 0)
      if (auto size = check_frame_size(stated.width, stated.height); !size) return size.error().message;
    codec_.reset(avcodec_alloc_context3(codec));
    if (avcodec_parameters_to_context(codec_.get(), &stated) < 0) return "sends no video that can be read";
    // Threads for the frames that follow each other would each hold one back.
    codec_->thread_type = FF_THREAD_SLICE;
    codec_->thread_count = 2;
    codec_->flags |= AV_CODEC_FLAG_LOW_DELAY;
    codec_->max_pixels = static_cast<std::int64_t>(kMostFramePixels);
    if (avcodec_open2(codec_.get(), codec, nullptr) < 0) return "sends video of a kind that cannot be read";
    return {};
  }

  /// Why the stream ends with this picture; empty: it goes on.
  std::string give(const AVFrame& frame, Clock::time_point arrival) {
    const std::uint64_t number = number_++;
    // FFmpeg fills what did not come with parts of other pictures.
    if ((frame.flags & AV_FRAME_FLAG_CORRUPT) != 0 || frame.decode_error_flags != 0) return {};
    if (auto size = check_frame_size(frame.width, frame.height); !size) return size.error().message;
    scaler_.reset(sws_getCachedContext(
        scaler_.release(), frame.width, frame.height, static_cast<AVPixelFormat>(frame.format), frame.width,
        frame.height, AV_PIX_FMT_RGB24, SWS_POINT | SWS_ACCURATE_RND, nullptr, nullptr, nullptr));
    if (!scaler_) return "sends video of a kind that cannot be read";
    const std::size_t stride = 3 * static_cast<std::size_t>(frame.width);
    const std::size_t bytes = stride * static_cast<std::size_t>(frame.height);
    rows_.resize(bytes + ffmpeg::kBeyondRow);
    ffmpeg::scale_to_rows(scaler_.get(), frame, reinterpret_cast<std::uint8_t*>(rows_.data()),
                          static_cast<int>(stride));
    const auto arrival_ns =
        std::chrono::duration_cast<std::chrono::nanoseconds>(arrival.time_since_epoch()).count();
    taker_.take({frame.width, frame.height, number, arrival_ns, std::span(rows_).first(bytes)});
    return taker_.is_there() ? std::string() : "is not needed any more";
  }

  StreamTaker& taker_;
  std::string url_;
  const AVFormatContext* opening_ = nullptr;
  bool is_redirected_ = false;
  Clock::time_point latest_;
  ffmpeg::Format format_;
  ffmpeg::Codec codec_;
  ffmpeg::Scaler scaler_;
  std::vector<std::byte> rows_;
  int stream_ = -1;
  std::uint64_t number_ = 0;
};

}  // namespace

std::string read_stream(const std::string& url, bool takes_any_certificate, StreamTaker& taker) {
  Stream stream(taker);
  auto refused = stream.open(url, takes_any_certificate);
  return refused.empty() ? stream.read() : refused;
}

}  // namespace palpable::sources::stream
