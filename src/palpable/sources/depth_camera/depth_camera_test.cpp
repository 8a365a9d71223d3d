// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth_camera/depth_camera.hpp"

#include "palpable/core/system/shared_library.hpp"
#include "palpable/sources/depth_camera/camera_pixels.hpp"
#include "palpable/sources/live/camera_stream.hpp"

#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

using std::chrono::milliseconds;
using Kind = DepthCamera::Kind;

/// As in virtual_cameras.cpp.
enum class VirtualFault { none, no_data, other_form, huge, short_block, no_colours, silent };

/// The libraries' double (virtual_cameras.cpp).
class DepthCameras : public testing::TestWithParam<Kind> {
 protected:
  void SetUp() override {
    const auto library = SharedLibrary::open(PALPABLE_VIRTUAL_CAMERAS, {});
    ASSERT_TRUE(library) << library.error().sentence();
    ASSERT_TRUE(library->bind(set_, "virtual_cameras_set"));
    ASSERT_TRUE(library->bind(open_, "virtual_cameras_open"));
    set(1, VirtualFault::none);
  }
  /// Nothing that the library gave is kept.
  void TearDown() override { EXPECT_EQ(open_(), 0); }

  void set(int cameras, VirtualFault fault, int frames = -1) {
    set_(cameras, frames, static_cast<int>(fault));
  }
  static DepthCamera camera() {
    DepthCamera named;
    named.kind = GetParam();
    named.library = PALPABLE_VIRTUAL_CAMERAS;
    return named;
  }
  /// The first frame, or what the link says instead.
  static Result<std::optional<DepthFrame>> first_of(DepthCameraLink& link) {
    return link.next(milliseconds(500));
  }

 private:
  void (*set_)(int, int, int) = nullptr;
  int (*open_)() = nullptr;
};

TEST_P(DepthCameras, GiveDepthsColoursAndTheirCamera) {
  const auto link = open_depth_camera(camera());
  ASSERT_TRUE(link) << link.error().sentence();
  const auto frame = first_of(**link);
  ASSERT_TRUE(frame && *frame) << (frame ? "none" : frame.error().sentence());
  const Raster<float>& depth_m = (*frame)->depth.depth_m;
  ASSERT_EQ(depth_m.width(), 640);
  ASSERT_EQ(depth_m.height(), 480);
  EXPECT_TRUE(std::isnan(depth_m(5, 0)));
  EXPECT_FLOAT_EQ(depth_m(100, 240), 1.0F);
  EXPECT_FLOAT_EQ(depth_m(500, 240), 0.8F);
  const auto& colour = (*frame)->colour;
  ASSERT_TRUE(colour);
  EXPECT_EQ(colour->pixel(100, 240)[0], 1.0F);
  EXPECT_EQ(colour->pixel(100, 240)[1], 0.0F);
  EXPECT_EQ(colour->pixel(500, 240)[1], 1.0F);
  const auto& seen_by = (*frame)->depth.camera;
  ASSERT_TRUE(seen_by);
  EXPECT_NEAR(seen_by->fx, GetParam() == Kind::freenect ? 525.0 : 500.0, 0.01);
  EXPECT_NEAR(seen_by->fy, GetParam() == Kind::freenect ? 525.0 : 500.0, 0.01);
  EXPECT_NEAR(seen_by->cx, 320.0, 0.51);
  EXPECT_EQ(seen_by->width, 640);
}

TEST_P(DepthCameras, CountTheirFramesFromTheFirst) {
  const auto link = open_depth_camera(camera());
  ASSERT_TRUE(link);
  const auto first = first_of(**link);
  const auto second = first_of(**link);
  ASSERT_TRUE(first && *first && second && *second);
  EXPECT_EQ((*first)->number, 0U);
  // The libraries that number frames tell of those that were missed.
  EXPECT_EQ((*second)->number, GetParam() == Kind::freenect ? 1U : 2U);
}

TEST_P(DepthCameras, WithoutColoursGiveTheirDepths) {
  set(1, VirtualFault::no_colours);
  const auto link = open_depth_camera(camera());
  ASSERT_TRUE(link) << link.error().sentence();
  const auto frame = first_of(**link);
  ASSERT_TRUE(frame && *frame) << (frame ? "none" : frame.error().sentence());
  EXPECT_FLOAT_EQ((*frame)->depth.depth_m(500, 240), 0.8F);
  EXPECT_FALSE((*frame)->colour);
}

TEST_P(DepthCameras, ThatAreNotThereAreCounted) {
  set(0, VirtualFault::none);
  const auto none = open_depth_camera(camera());
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::device);
  EXPECT_EQ(none.error().message, std::string(library_name(GetParam())) +
                                      " finds no camera: is it plugged in, and may you use it?");
  set(2, VirtualFault::none);
  DepthCamera third = camera();
  third.number = 2;
  const auto missing = open_depth_camera(third);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message,
            std::string(library_name(GetParam())) + " finds 2 cameras, counted from 0");
}

TEST_P(DepthCameras, ThatAreUnpluggedAreLostWithAReason) {
  set(1, VirtualFault::none, 2);
  const auto link = open_depth_camera(camera());
  ASSERT_TRUE(link);
  for (int k = 0; k < 2; ++k) {
    const auto frame = first_of(**link);
    ASSERT_TRUE(frame && *frame);
  }
  const auto lost = first_of(**link);
  ASSERT_FALSE(lost);
  EXPECT_NE(lost.error().message.find("unplugged"), std::string::npos) << lost.error().message;
  EXPECT_EQ(lost.error().message.find('\n'), std::string::npos);
}

TEST_P(DepthCameras, ThatSendNothingAreLostAfterATime) {
  set(1, VirtualFault::silent);
  DepthCamera impatient = camera();
  impatient.silence = milliseconds(100);
  const auto link = open_depth_camera(impatient);
  ASSERT_TRUE(link);
  Result<std::optional<DepthFrame>> next = std::optional<DepthFrame>();
  for (int tries = 0; tries < 500 && next; ++tries) {
    next = (*link)->next(milliseconds(1));
    EXPECT_FALSE(next && *next);
  }
  ASSERT_FALSE(next);
  EXPECT_EQ(next.error().message, "has sent no depths for 0.1 s");
}

/// What cannot be read gives a sentence, and no access beyond the block that the library states.
TEST_P(DepthCameras, ThatSendRubbishAreRefused) {
  for (const auto fault :
       {VirtualFault::no_data, VirtualFault::other_form, VirtualFault::huge, VirtualFault::short_block}) {
    // Sizes are the program's own there, and the callback states none.
    if (GetParam() == Kind::freenect && (fault == VirtualFault::huge || fault == VirtualFault::short_block))
      continue;
    set(1, fault);
    DepthCamera impatient = camera();
    impatient.silence = milliseconds(20);
    const auto link = open_depth_camera(impatient);
    if (!link) {
      EXPECT_FALSE(link.error().message.empty());
      continue;
    }
    const auto frame = (*link)->next(milliseconds(60));
    EXPECT_FALSE(frame) << static_cast<int>(fault);
  }
}

/// As each of the three is opened and opened again beside a touch.
TEST_P(DepthCameras, AreTriedAgainWhenTheyWereLost) {
  set(1, VirtualFault::none, 3);
  const auto stream =
      DepthCameraStream::open([] { return open_depth_camera(camera()); }, "openni:0", milliseconds(5));
  ASSERT_TRUE(stream) << stream.error().sentence();
  std::optional<std::string> loss;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!loss && std::chrono::steady_clock::now() < end) {
    const auto frame = (*stream)->take(std::chrono::steady_clock::now() + milliseconds(20));
    ASSERT_TRUE(frame) << frame.error().sentence();
    loss = (*stream)->loss();
  }
  ASSERT_TRUE(loss);
  EXPECT_EQ(loss->find("The camera openni:0 was lost: it "), 0U) << *loss;
}

INSTANTIATE_TEST_SUITE_P(Libraries, DepthCameras,
                         testing::Values(Kind::openni, Kind::freenect, Kind::realsense),
                         [](const auto& kind) { return std::string(library_name(kind.param)); });

TEST(DepthCamera, WhoseLibraryIsMissingOrAnotherIsRefused) {
  for (const auto kind : {Kind::openni, Kind::freenect, Kind::realsense}) {
    DepthCamera camera;
    camera.kind = kind;
    camera.library = "/nowhere/lib.so";
    const auto missing = open_depth_camera(camera);
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::device);
    camera.library = PALPABLE_ANOTHER_LIBRARY;
    const auto another = open_depth_camera(camera);
    ASSERT_FALSE(another);
    EXPECT_NE(another.error().message.find("has no function"), std::string::npos) << another.error().message;
  }
}

TEST(CameraPixels, AreNeverReadBeyondTheirBlock) {
  std::array<std::uint16_t, 6> values{1, 2, 3, 4, 5, 6};
  const auto refused = [&](int width, int height, std::size_t stride, std::size_t bytes) {
    return !depth_of_pixels({values.data(), width, height, stride, bytes}, 0.001);
  };
  EXPECT_FALSE(refused(3, 2, 6, 12));
  // The last row may be without its padding.
  EXPECT_FALSE(refused(2, 2, 6, 10));
  EXPECT_TRUE(refused(3, 2, 6, 11));
  EXPECT_TRUE(refused(3, 2, 4, 12));
  EXPECT_TRUE(refused(3, 2, static_cast<std::size_t>(-1), 12));
  EXPECT_TRUE(refused(0, 2, 6, 12));
  EXPECT_TRUE(refused(3, -2, 6, 12));
  EXPECT_FALSE(depth_of_pixels({nullptr, 3, 2, 6, 12}, 0.001));
  EXPECT_FALSE(depth_of_pixels({values.data(), 3, 2, 6, 12}, std::nan("")));
  const auto read = depth_of_pixels({values.data(), 2, 2, 6, 10}, 0.5);
  ASSERT_TRUE(read);
  EXPECT_FLOAT_EQ((*read)(1, 1), 2.5F);
}

}  // namespace
}  // namespace palpable::sources
