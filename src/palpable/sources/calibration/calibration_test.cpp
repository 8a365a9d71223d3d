// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/calibration/calibration.hpp"

#include "palpable/core/files/byte_reader.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

constexpr const char* kMiddlebury =
    "cam0=[994.978 0 311.193; 0 994.978 254.877; 0 0 1]\ncam1=[994.978 0 342.279; 0 994.978 254.877; 0 0 1]\n"
    "doffs=31.086\nbaseline=193.001\nwidth=741\nheight=500\nndisp=70\nisint=0\n";

constexpr const char* kOpenCv = R"(%YAML:1.0
---
M1: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 500., 0., 320., 0., 510., 240., 0., 0., 1. ]
D1: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ 0.1, -0.2, 0., 0., 0.01 ]
M2: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 501., 0., 321., 0., 511., 241., 0., 0., 1. ]
D2: !!opencv-matrix
   rows: 1
   cols: 4
   dt: d
   data: [ 0.1, -0.2, 0., 0. ]
R: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 1., 0., 0., 0., 1., 0., 0., 0., 1. ]
T: !!opencv-matrix
   rows: 3
   cols: 1
   dt: d
   data: [ -60., 0., 0.5 ]
metres_per_unit: 0.001
image_width: 640
image_height: 480
)";

TEST(Calibration, OfMiddleburyIsARectifiedPair) {
  const auto c = decode_calibration(as_bytes(kMiddlebury));
  ASSERT_TRUE(c) << c.error().message;
  ASSERT_TRUE(c->rig);
  EXPECT_NEAR(c->rig->baseline_m, 0.193001, 1e-12);
  EXPECT_DOUBLE_EQ(c->rig->doffs_px, 31.086);
  EXPECT_DOUBLE_EQ(c->rig->left.cx, 311.193);
  EXPECT_EQ(c->rig->left.width, 741);
  EXPECT_DOUBLE_EQ(c->right->matrix[2], 342.279);
}

TEST(Calibration, OfOpenCvHoldsLensesAndPlacesInMetres) {
  const auto c = decode_calibration(as_bytes(kOpenCv));
  ASSERT_TRUE(c) << c.error().message;
  EXPECT_FALSE(c->rig);
  EXPECT_DOUBLE_EQ(c->left.matrix[4], 510.0);
  EXPECT_DOUBLE_EQ(c->right->matrix[5], 241.0);
  EXPECT_EQ(c->left.distortion.size(), 5U);
  EXPECT_EQ(c->right->distortion.size(), 4U);
  EXPECT_DOUBLE_EQ(c->translation_m->x, -0.06);
  EXPECT_DOUBLE_EQ(c->translation_m->z, 0.0005);
  EXPECT_EQ(c->right->width, 640);
  EXPECT_TRUE(c->notes.empty());
}

TEST(Calibration, InMillimetresThatDoesNotSaySoIsNoticed) {
  std::string text = kOpenCv;
  text.erase(text.find("metres_per_unit"), std::string("metres_per_unit: 0.001\n").size());
  const auto c = decode_calibration(as_bytes(text));
  ASSERT_TRUE(c);
  ASSERT_EQ(c->notes.size(), 1U);
  EXPECT_NE(c->notes[0].find("60 m apart"), std::string::npos) << c->notes[0];
}

TEST(Calibration, StatesItsPictureInWholePixels) {
  const auto with_width = [](const std::string& width) {
    const std::string text = R"({"fx":525,"fy":525,"cx":40,"cy":40,"height":80,"width":)" + width + "}";
    return decode_calibration(as_bytes(text));
  };
  EXPECT_TRUE(with_width("80"));
  EXPECT_TRUE(with_width("80.0"));
  for (const char* const width : {"80.9", "80.0000000001", "79.6"}) {
    const auto calibration = with_width(width);
    ASSERT_FALSE(calibration) << width;
    EXPECT_NE(calibration.error().message.find("whole pixels"), std::string::npos);
  }
}

TEST(Calibration, OfJsonKnowsOneCameraOrARectifiedPair) {
  const std::string one = R"({"fx":525,"fy":525.5,"cx":319.5,"cy":239.5,"width":640,"height":480)";
  const auto c = decode_calibration(as_bytes(one + "}"));
  ASSERT_TRUE(c) << c.error().message;
  EXPECT_FALSE(c->rig);
  EXPECT_FALSE(c->right);
  EXPECT_EQ(pinhole_of(c->left), (Pinhole{525, 525.5, 319.5, 239.5, 640, 480}));
  const auto pair = decode_calibration(as_bytes(one + R"(,"baseline_m":0.06,"doffs":2})"));
  ASSERT_TRUE(pair);
  EXPECT_EQ(*pair->rig, (StereoRig{{525, 525.5, 319.5, 239.5, 640, 480}, 0.06, 2.0}));
}

TEST(Calibration, OfAnotherSizeIsScaledWhereTheShapeAgrees) {
  const auto c = decode_calibration(as_bytes(kMiddlebury));
  const auto same = calibration_for(*c, 741, 500);
  ASSERT_TRUE(same);
  EXPECT_TRUE(same->notes.empty());
  const auto twice = calibration_for(*c, 1482, 1000);
  ASSERT_TRUE(twice);
  EXPECT_EQ(twice->notes.size(), 1U);
  EXPECT_DOUBLE_EQ(twice->rig->left.fx, 2 * 994.978);
  EXPECT_DOUBLE_EQ(twice->rig->left.cx, 2 * 311.693 - 0.5);
  EXPECT_DOUBLE_EQ(twice->rig->doffs_px, 2 * 31.086);
  // The same point has the same depth: disparity doubles with the size of the picture.
  const double z = c->rig->baseline_m * c->rig->left.fx / (40.0 + c->rig->doffs_px);
  EXPECT_NEAR(twice->rig->baseline_m * twice->rig->left.fx / (80.0 + twice->rig->doffs_px), z, 1e-12);
}

TEST(Calibration, OfAnotherShapeIsRefusedWithBothSizes) {
  const auto refused = calibration_for(*decode_calibration(as_bytes(kMiddlebury)), 640, 480);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "is for pictures of 741 x 500 pixels, but these have 640 x 480");
}

TEST(Calibration, WithoutSizeMustHaveItsAxisInThePictures) {
  std::string text = kOpenCv;
  text.erase(text.find("image_width"));
  const auto c = decode_calibration(as_bytes(text));
  ASSERT_TRUE(c);
  EXPECT_TRUE(calibration_for(*c, 640, 480));
  EXPECT_FALSE(calibration_for(*c, 300, 200));
}

TEST(Calibration, ThatIsDamagedOrImpossibleIsRefusedWithASentence) {
  const std::string yml = kOpenCv;
  for (const std::string& text :
       {std::string(), std::string("hello"), std::string("{}"), std::string("{\"fx\":1"),
        std::string(R"({"fx":0,"fy":1,"cx":1,"cy":1,"width":4,"height":4})"),
        std::string(R"({"fx":1e308,"fy":1,"cx":1,"cy":1,"width":4,"height":4})"),
        std::string(R"({"fx":1,"fy":1e-9,"cx":1,"cy":1,"width":4,"height":4})"),
        std::string(R"({"fx":1,"fy":1,"cx":1e12,"cy":1,"width":4,"height":4})"),
        std::string(R"({"fx":1,"fy":1,"cx":1,"cy":1,"width":-4,"height":4})"),
        std::string(R"({"fx":1,"fy":1,"cx":1,"cy":1,"width":4,"height":4,"baseline_m":1e300})"),
        std::string(R"({"fx":1,"fy":1,"cx":1,"cy":1,"width":4,"height":4,"baseline_m":0})"),
        std::string("cam0=[1 2 3]\n"),
        std::string("cam0=[9 0 1;0 9 1;0 0 1]\ncam1=[9 0 1;0 9 1;0 0 1]\nwidth=4\nheight=4\n"),
        std::string("%YAML:1.0\n---\nM1: 3\n"), std::string("%YAML:1.0\n---\n[[[[: {"),
        std::string("<?xml version=\"1.0\"?><a>"), yml.substr(0, 140), yml + "\nbad\n  : :"}) {
    const auto c = decode_calibration(as_bytes(text));
    EXPECT_FALSE(c) << text;
    if (!c) {
      EXPECT_EQ(c.error().code, ErrorCode::invalid_input);
    }
  }
  const auto endless =
      decode_calibration(as_bytes(std::string(R"({"fx":1e308,"fy":1,"cx":1,"cy":1,"width":4,"height":4})")));
  EXPECT_EQ(endless.error().message, "states a focal length of 1e+308 pixels; it must be 0.1 to 1000000");
  std::string turned = yml;
  turned.replace(turned.find("1., 0., 0., 0., 1."), 2, "2.");
  EXPECT_FALSE(decode_calibration(as_bytes(turned)));
  EXPECT_FALSE(read_calibration("/no/such/calib.txt"));
}

TEST(Calibration, WhoseMatrixStatesAnotherSizeThanItHasIsRefusedBeforeMemoryIsTaken) {
  std::string text = kOpenCv;
  const std::string rows = "rows: 3";
  text.replace(text.find(rows), rows.size(), "rows: 2000000000");
  const auto calibration = decode_calibration(as_bytes(text));
  ASSERT_FALSE(calibration);
  EXPECT_NE(calibration.error().message.find("3 x 3 camera matrix"), std::string::npos);
}

TEST(Calibration, OfRealFilesIsRead) {
  const char* data = std::getenv("PALPABLE_DATA");
  if (data == nullptr) GTEST_SKIP() << "PALPABLE_DATA is not set";
  const auto stereo = std::filesystem::path(data) / "stereo";
  const auto heads = read_calibration(stereo / "rendered_heads/calib.txt");
  ASSERT_TRUE(heads) << heads.error().sentence();
  const auto json = read_calibration(stereo / "rendered_heads/calib.json");
  ASSERT_TRUE(json) << json.error().sentence();
  EXPECT_EQ(*heads->rig, *json->rig);
  const auto board = read_calibration(stereo / "calib_chessboard/intrinsics.yml");
  ASSERT_TRUE(board) << board.error().sentence();
  EXPECT_TRUE(calibration_for(*board, 640, 480));
  const auto one = read_calibration(stereo / "calib_chessboard/left_intrinsics.yml");
  ASSERT_TRUE(one) << one.error().sentence();
  EXPECT_FALSE(one->right);
}

TEST(Calibration, WrittenAsYmlComesBackTheSame) {
  Calibration c;
  c.left = {{500.25, 0, 319.5, 0, 501, 239, 0, 0, 1}, {0.1, -0.2, 0, 1e-5, 0.03}, 640, 480};
  c.right = c.left;
  c.right->matrix[2] = 300.125;
  c.rotation = std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1};
  c.translation_m = Vec3{-0.0832, 0.001, 1e-7};
  const std::string yml = encode_calibration(c, 0.215);
  const auto back = decode_calibration(std::as_bytes(std::span(yml)));
  ASSERT_TRUE(back) << back.error().sentence();
  EXPECT_EQ(back->left.matrix, c.left.matrix);
  EXPECT_EQ(back->left.distortion, c.left.distortion);
  EXPECT_EQ(back->left.width, 640);
  EXPECT_EQ(back->right->matrix, c.right->matrix);
  EXPECT_EQ(back->translation_m->x, c.translation_m->x);
  EXPECT_EQ(back->translation_m->z, c.translation_m->z);
  Calibration single;
  single.left = c.left;
  const std::string one = encode_calibration(single, 0.3);
  const auto alone = decode_calibration(std::as_bytes(std::span(one)));
  ASSERT_TRUE(alone) << alone.error().sentence();
  EXPECT_FALSE(alone->right);
  EXPECT_EQ(alone->left.matrix, single.left.matrix);
}

}  // namespace
}  // namespace palpable::sources
