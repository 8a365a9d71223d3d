// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/stream/stream_camera.hpp"

#include "palpable/sources/live/camera_stream.hpp"
#include "palpable/sources/stream/test_rtsp_server.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace palpable::sources {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// The pictures of a camera until `count` came or its link is lost, and why it was, within twenty seconds.
struct Seen {
  std::vector<CameraFrame> frames;
  std::string loss;
};
Seen seen_of(const std::string& url, std::size_t count, bool takes_any_certificate = false) {
  Seen seen;
  auto link = connect_stream_camera({url, takes_any_certificate, url});
  if (!link) return {{}, link.error().message};
  const auto end = Clock::now() + std::chrono::seconds(20);
  while (Clock::now() < end && seen.frames.size() < count) {
    auto frame = (*link)->next(milliseconds(50));
    if (!frame) {
      seen.loss = frame.error().message;
      break;
    }
    if (*frame) seen.frames.push_back(**std::move(frame));
  }
  return seen;
}

TEST(StreamCamera, GivesThePicturesOfAnRtspCamera) {
  const RtspServer server;
  const auto seen = seen_of(server.url(), 5);
  ASSERT_EQ(seen.frames.size(), 5U) << seen.loss;
  EXPECT_LT(seen.frames.front().number, seen.frames.back().number);
  for (const CameraFrame& frame : seen.frames) {
    EXPECT_LE(frame.arrival, Clock::now());
    const auto picture = picture_of(frame);
    ASSERT_TRUE(picture) << picture.error().message;
    ASSERT_EQ(picture->width, 64);
    ASSERT_EQ(picture->height, 48);
    const float* left = picture->samples.data() + 3 * (24 * 64 + 8);
    const float* right = picture->samples.data() + 3 * (24 * 64 + 56);
    EXPECT_GT(left[0], 0.8F);
    EXPECT_LT(left[2], 0.2F);
    EXPECT_LT(right[0], 0.2F);
    EXPECT_GT(right[2], 0.8F);
  }
}

TEST(StreamCamera, ReadsPicturesOfManyPackets) {
  RtspBehaviour large;
  large.width = 1920, large.height = 1080;
  const RtspServer server(large);
  const auto seen = seen_of(server.url(), 2);
  ASSERT_EQ(seen.frames.size(), 2U) << seen.loss;
  EXPECT_EQ(seen.frames.back().bytes.size(), 3U * 1920U * 1080U);
}

TEST(StreamCamera, SaysWhyThereAreNoPictures) {
  const RtspServer server;
  EXPECT_EQ(seen_of(server.url("/other"), 1).loss, "has no such stream");
  RtspBehaviour closed;
  closed.takes_everybody = false;
  const RtspServer guarded(closed);
  EXPECT_EQ(seen_of(guarded.url(), 1).loss,
            "refuses the name and password, or asks for them: NAME:PASSWORD@ before the host");
  EXPECT_EQ(seen_of("rtsp://127.0.0.1:1/stream", 1).loss, "cannot be reached: Connection refused");
}

TEST(StreamCamera, IsLostWhenTheCameraEnds) {
  RtspBehaviour brief;
  brief.ends_after = 25;
  const RtspServer server(brief);
  const auto seen = seen_of(server.url(), 100);
  EXPECT_GE(seen.frames.size(), 1U);
  EXPECT_EQ(seen.loss, "has ended the stream");
}

TEST(StreamCamera, IsLostWhenTheCameraIsSilent) {
  RtspBehaviour mute;
  mute.silent_after = 25;
  const RtspServer server(mute);
  EXPECT_EQ(seen_of(server.url(), 100).loss, "has sent nothing for 5 s");
}

TEST(StreamCamera, SurvivesRubbishBetweenPictures) {
  RtspBehaviour noisy;
  noisy.rubbish_after = 25;
  const RtspServer server(noisy);
  const auto seen = seen_of(server.url(), 40);
  EXPECT_GE(seen.frames.size(), 1U);
  EXPECT_EQ(seen.loss.find("crashed"), std::string::npos);
}

// The file is a stream that could be read.
TEST(StreamCamera, OpensNoFilesAndNoOtherProtocols) {
  const std::string file = testing::TempDir() + "/pictures.mjpeg";
  std::vector<unsigned char> picture;
  cv::imencode(".jpg", cv::Mat(48, 64, CV_8UC3, cv::Scalar(200, 100, 50)), picture);
  for (int k = 0; k < 20; ++k)
    std::ofstream(file, std::ios::app | std::ios::binary)
        .write(reinterpret_cast<const char*>(picture.data()), static_cast<std::streamsize>(picture.size()));
  for (const std::string& url : {file, "file:" + file, "concat:" + file, std::string("rtp://127.0.0.1:9")}) {
    const auto seen = seen_of(url, 1);
    EXPECT_TRUE(seen.frames.empty()) << url;
    EXPECT_NE(seen.loss, "") << url;
  }
}

TEST(StreamCamera, SurvivesADecoderThatIsMissingOrOfAnotherVersion) {
  ::setenv("PALPABLE_STREAM_DECODER", "/bin/true", 1);
  EXPECT_NE(seen_of("rtsp://127.0.0.1:1/", 1).loss.find("installation of Palpable is incomplete"),
            std::string::npos);
  ::setenv("PALPABLE_STREAM_DECODER", "/nowhere", 1);
  EXPECT_NE(seen_of("rtsp://127.0.0.1:1/", 1).loss.find("cannot be started"), std::string::npos);
  ::unsetenv("PALPABLE_STREAM_DECODER");
}

TEST(StreamCamera, ChecksWhatItsDecoderSends) {
  const auto program = std::filesystem::path(testing::TempDir()) / "decoder_of_rubbish";
  const auto loss_of = [&](const std::string& sent) {
    std::ofstream(program) << "#!/bin/sh\n" << sent << " >&4\nsleep 20\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    return seen_of("rtsp://127.0.0.1:1/", 1).loss;
  };
  ::setenv("PALPABLE_STREAM_DECODER", program.c_str(), 1);
  EXPECT_EQ(loss_of("head -c 100000 /dev/urandom"), "sent something that took its decoder over");
  // A picture of 16384 by 16384 pixels.
  EXPECT_EQ(loss_of("printf '\\2\\0\\0\\0\\0\\100\\0\\0\\0\\100\\0\\0' && head -c 100 /dev/zero"),
            "sent something that took its decoder over");
  ::unsetenv("PALPABLE_STREAM_DECODER");
}

}  // namespace
}  // namespace palpable::sources
