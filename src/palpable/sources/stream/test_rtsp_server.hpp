// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sources/video/ffmpeg_owned.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

extern "C" {
#include <libavutil/log.h>
#include <libavutil/opt.h>
}

namespace palpable::sources {

/// What an RTSP camera of the tests does.
struct RtspBehaviour {
  int width = 64, height = 48;
  /// Without it every request is answered by 401.
  bool takes_everybody = true;
  /// The sender goes silent, or ends the connection, after so many pictures; -1: never.
  int silent_after = -1, ends_after = -1;
  /// After so many pictures it sends bytes that are none; -1: never.
  int rubbish_after = -1;
};

/// A network camera: H.264 by RTP within RTSP's connection (RFC 2326, 3550, 6184). Pictures are red on the
/// left and blue on the right.
class RtspServer {
 public:
  explicit RtspServer(RtspBehaviour behaviour = {}) : behaviour_(behaviour) {
    av_log_set_level(AV_LOG_QUIET);
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (::bind(listener_, reinterpret_cast<sockaddr*>(&address), size) != 0 || ::listen(listener_, 4) != 0 ||
        ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
      throw std::runtime_error("no port for a camera");
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { run(); });
  }
  ~RtspServer() {
    ending_ = true;
    thread_.join();
    ::close(listener_);
  }
  RtspServer(const RtspServer&) = delete;
  RtspServer& operator=(const RtspServer&) = delete;

  std::string url(const char* path = "/stream") const {
    return "rtsp://127.0.0.1:" + std::to_string(port_) + path;
  }

 private:
  void run() {
    while (!ending_) {
      pollfd wait{listener_, POLLIN, 0};
      if (::poll(&wait, 1, 20) != 1) continue;
      const int client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
      serve(client);
      ::close(client);
    }
  }

  void serve(int client) {
    std::string waiting;
    bool plays = false;
    int pictures = 0;
    start_encoder();
    while (!ending_) {
      pollfd wait{client, POLLIN, 0};
      if (::poll(&wait, 1, plays ? 30 : 20) == 1) {
        std::array<char, 2048> some{};
        const ssize_t count = ::recv(client, some.data(), some.size(), 0);
        if (count <= 0) return;
        waiting.append(some.data(), static_cast<std::size_t>(count));
      }
      for (auto end = waiting.find("\r\n\r\n"); end != std::string::npos; end = waiting.find("\r\n\r\n")) {
        plays = answer(client, waiting.substr(0, end)) || plays;
        waiting.erase(0, end + 4);
      }
      if (!plays || pictures == behaviour_.silent_after) continue;
      if (pictures == behaviour_.ends_after) return;
      if (pictures == behaviour_.rubbish_after) send_all(client, std::string(5000, '$'));
      send_picture(client, pictures++);
    }
  }

  /// Whether the pictures begin.
  bool answer(int client, const std::string& request) {
    const auto at = request.find("CSeq:");
    const std::string number = at == std::string::npos ? "0" : std::to_string(std::atoi(&request[at + 5]));
    const std::string head = "\r\nCSeq: " + number + "\r\n";
    const auto send = [&](const std::string& text) { send_all(client, "RTSP/1.0 " + text); };
    if (!behaviour_.takes_everybody) {
      send("401 Unauthorized" + head + "WWW-Authenticate: Basic realm=\"camera\"\r\n\r\n");
    } else if (request.find("/stream") == std::string::npos) {
      send("404 Not Found" + head + "\r\n");
    } else if (request.starts_with("OPTIONS")) {
      send("200 OK" + head + "Public: OPTIONS, DESCRIBE, SETUP, PLAY, TEARDOWN\r\n\r\n");
    } else if (request.starts_with("DESCRIBE")) {
      const std::string description =
          "v=0\r\no=- 0 0 IN IP4 127.0.0.1\r\ns=camera\r\nc=IN IP4 0.0.0.0\r\nt=0 0\r\nm=video 0 RTP/AVP "
          "96\r\n"
          "a=rtpmap:96 H264/90000\r\na=fmtp:96 packetization-mode=1\r\na=control:track1\r\n";
      send("200 OK" + head + "Content-Type: application/sdp\r\nContent-Length: " +
           std::to_string(description.size()) + "\r\n\r\n" + description);
    } else if (request.starts_with("SETUP")) {
      send("200 OK" + head + "Transport: RTP/AVP/TCP;unicast;interleaved=0-1\r\nSession: 1\r\n\r\n");
    } else {
      send("200 OK" + head + "Session: 1\r\n\r\n");
      return request.starts_with("PLAY");
    }
    return false;
  }

  void start_encoder() {
    const AVCodec* codec = avcodec_find_encoder_by_name("libx264");
    if (codec == nullptr) throw std::runtime_error("FFmpeg has no encoder of H.264");
    encoder_.reset(avcodec_alloc_context3(codec));
    encoder_->width = behaviour_.width, encoder_->height = behaviour_.height;
    encoder_->pix_fmt = AV_PIX_FMT_YUV420P;
    encoder_->time_base = {1, 30};
    encoder_->gop_size = 1;
    encoder_->thread_count = 1;
    av_opt_set(encoder_->priv_data, "preset", "ultrafast", 0);
    av_opt_set(encoder_->priv_data, "tune", "zerolatency", 0);
    if (avcodec_open2(encoder_.get(), codec, nullptr) < 0) throw std::runtime_error("no encoder of H.264");
  }

  void send_picture(int client, int number) {
    const ffmpeg::Frame frame(av_frame_alloc());
    frame->width = behaviour_.width, frame->height = behaviour_.height;
    frame->format = AV_PIX_FMT_YUV420P;
    frame->pts = number;
    av_frame_get_buffer(frame.get(), 0);
    for (int plane = 0; plane < 3; ++plane) {
      const int w = plane == 0 ? frame->width : frame->width / 2,
                h = plane == 0 ? frame->height : frame->height / 2;
      // Red is 81, 90, 240 and blue 41, 240, 110 in BT.601 of limited range.
      constexpr std::array<std::array<int, 2>, 3> kColours{{{81, 41}, {90, 240}, {240, 110}}};
      for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
          frame->data[plane][y * frame->linesize[plane] + x] =
              static_cast<std::uint8_t>(kColours[static_cast<std::size_t>(plane)][x < w / 2 ? 0 : 1]);
    }
    const ffmpeg::Packet packet(av_packet_alloc());
    avcodec_send_frame(encoder_.get(), frame.get());
    while (avcodec_receive_packet(encoder_.get(), packet.get()) == 0) {
      send_units(client,
                 {reinterpret_cast<const char*>(packet->data), static_cast<std::size_t>(packet->size)},
                 number);
      av_packet_unref(packet.get());
    }
  }

  /// The units between start codes.
  void send_units(int client, std::string_view stream, int number) {
    using namespace std::string_view_literals;
    auto at = stream.find("\0\0\1"sv);
    while (at != std::string_view::npos) {
      const auto next = stream.find("\0\0\1"sv, at + 3);
      auto unit = stream.substr(at + 3, next == std::string_view::npos ? next : next - at - 3);
      while (!unit.empty() && unit.back() == '\0') unit.remove_suffix(1);
      send_unit(client, unit, number, next == std::string_view::npos);
      at = next;
    }
  }

  void send_unit(int client, std::string_view unit, int number, bool is_last) {
    constexpr std::size_t kMost = 1200;
    if (unit.size() <= kMost) return send_packet(client, std::string(unit), number, is_last);
    // Fragments (FU-A): the unit's type is in their second byte.
    const auto first = static_cast<unsigned char>(unit.front());
    for (std::size_t at = 1; at < unit.size(); at += kMost) {
      const bool ends = at + kMost >= unit.size();
      std::string part{static_cast<char>((first & 0xE0U) | 28U),
                       static_cast<char>((at == 1 ? 0x80U : 0U) | (ends ? 0x40U : 0U) | (first & 0x1FU))};
      send_packet(client, part.append(unit.substr(at, kMost)), number, is_last && ends);
    }
  }

  void send_packet(int client, const std::string& payload, int number, bool is_last) {
    const std::uint32_t time = 3000U * static_cast<std::uint32_t>(number);
    const std::uint16_t sequence = sequence_++;
    std::string packet{'$', '\0'};
    const auto put = [&](std::uint32_t value, int bytes) {
      for (int k = bytes - 1; k >= 0; --k) packet += static_cast<char>((value >> (8 * k)) & 0xFFU);
    };
    put(static_cast<std::uint32_t>(payload.size() + 12), 2);
    put(0x80U, 1);
    put(is_last ? 0xE0U : 0x60U, 1);
    put(sequence, 2);
    put(time, 4);
    put(1, 4);
    send_all(client, packet + payload);
  }

  static void send_all(int client, const std::string& text) {
    std::size_t at = 0;
    while (at < text.size()) {
      const ssize_t count = ::send(client, text.data() + at, text.size() - at, MSG_NOSIGNAL);
      if (count <= 0) return;
      at += static_cast<std::size_t>(count);
    }
  }

  RtspBehaviour behaviour_;
  int listener_ = -1;
  int port_ = 0;
  ffmpeg::Codec encoder_;
  std::uint16_t sequence_ = 0;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace palpable::sources
