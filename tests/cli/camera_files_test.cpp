// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/picture/picture.hpp"
#include "palpable/formats/picture/png.hpp"
#include "palpable/sources/picture/made_files.hpp"

#include <filesystem>
#include <tuple>

#include "program.hpp"
#include "test_pictures.hpp"
#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

// Files of consumer cameras with every command that reads them.
namespace palpable::test {
namespace {

using ::testing::HasSubstr;

std::string jpeg(const Raster<Rgb8>& picture) {
  cv::Mat mat(picture.height(), picture.width(), CV_8UC3);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const Rgb8 p = picture(x, y);
      mat.at<cv::Vec3b>(y, x) = {p.b, p.g, p.r};
    }
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", mat, bytes, {cv::IMWRITE_JPEG_QUALITY, 95});
  return {bytes.begin(), bytes.end()};
}

/// Two pictures side by side, or one above the other.
Raster<Rgb8> joined(const Raster<Rgb8>& first, const Raster<Rgb8>& second, bool beside) {
  const int w = first.width(), h = first.height();
  Raster<Rgb8> out(beside ? 2 * w : w, beside ? h : 2 * h);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      out(x, y) = first(x, y);
      out(x + (beside ? w : 0), y + (beside ? 0 : h)) = second(x, y);
    }
  return out;
}

class CameraFiles : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    pair_ = textured_pair(240, 180);
    ASSERT_TRUE(formats::write_disparity_pfm(path("truth.pfm"), pair_.disparity_px));
  }
  /// A file with the pair works with depth, fit, make and touch.
  void expect_taken(const std::string& file, const std::vector<std::string>& options = {}) {
    const auto with = [&](std::vector<std::string> words) {
      words.insert(words.end(), options.begin(), options.end());
      words.emplace_back("--json");
      return palpable(words);
    };
    const Outcome depth = with({"depth", path(file), "-o", path("d.pfm"), "--method", "fast"});
    ASSERT_EQ(depth.exit_code, 0) << file << ": " << depth.err;
    EXPECT_EQ(depth.json()["width"], 240) << file;
    EXPECT_LT(palpable({"score", "disparity", path("d.pfm"), path("truth.pfm"), "--json"}).json()["bad"]["2"],
              20.0)
        << file;
    EXPECT_GT(with({"fit", path(file)}).json()["agreement"], 0.7) << file;
    std::vector<std::string> make{"make", path(file), "-o", path("s.palp"), "--method", "fast"};
    std::vector<std::string> touch{"touch", path(file), "--method", "fast", "--headless", "--seconds", "0.1"};
    if (!options.empty())
      for (auto* words : {&make, &touch}) words->insert(words->end(), {"--kind", "stereo"});
    const Outcome made = with(make);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    const auto source = palpable({"info", path("s.palp"), "--json"}).json()["source"];
    EXPECT_EQ(source["method"], "stereo, fast") << file;
    EXPECT_EQ(source["paper"], "Hirschmüller 2008") << file;
    const Outcome touched = with(touch);
    EXPECT_EQ(touched.exit_code, 0) << touched.err;
    EXPECT_GT(touched.json()["servo"]["ticks"], 0);
  }
  Pair pair_;
};

TEST_F(CameraFiles, MpoAndJpsFilesContainAPair) {
  write_text(path("camera.mpo"), sources::mpo(jpeg(pair_.left), jpeg(pair_.right), sources::kDisparity));
  expect_taken("camera.mpo");
  constexpr std::uint32_t kSideBySide = 0x0201;
  write_text(path("camera.jps"), sources::jps(jpeg(joined(pair_.right, pair_.left, true)), kSideBySide));
  expect_taken("camera.jps");
}

TEST_F(CameraFiles, OnePictureContainsAPairSideBySideOrAboveEachOther) {
  ASSERT_TRUE(formats::write_png(path("beside.png"), joined(pair_.left, pair_.right, true)));
  expect_taken("beside.png", {"--layout", "side-by-side"});
  ASSERT_TRUE(formats::write_png(path("above.png"), joined(pair_.right, pair_.left, false)));
  expect_taken("above.png", {"--layout", "over-under-crossed"});
}

TEST_F(CameraFiles, APhonesPhotographIsDepthUnlessContoursAreRequested) {
  Raster<std::uint8_t> near(240, 180);
  for (std::size_t i = 0; i < near.count(); ++i)
    near.values()[i] = static_cast<std::uint8_t>(255.0F - 20.0F * pair_.disparity_px.values()[i]);
  const auto png = formats::encode_png(near);
  ASSERT_TRUE(png);
  const std::string data(reinterpret_cast<const char*>(png->data()), png->size());
  const std::string photo = jpeg(pair_.left);
  write_text(path("phone.jpg"),
             photo.substr(0, 2) +
                 sources::segment(sources::kXmpName +
                                  "<a GDepth:Format=\"RangeInverse\" GDepth:Near=\"0.5\" GDepth:Far=\"8\" "
                                  "GDepth:Mime=\"image/png\" GDepth:Data=\"" +
                                  sources::base64(data) + "\"/>") +
                 photo.substr(2));
  const Outcome made = palpable({"make", path("phone.jpg"), "-o", path("s.palp"), "--json"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("holds depth"));
  const auto info = palpable({"info", path("s.palp"), "--json"}).json();
  EXPECT_EQ(info["kind"], "relief");
  EXPECT_EQ(info["source"]["method"], "depth map");
  EXPECT_EQ(palpable({"touch", path("phone.jpg"), "--headless", "--seconds", "0.1"}).exit_code, 0);
  for (const std::vector<std::string>& wish :
       {std::vector<std::string>{"--kind", "picture"}, {"--as", "contours"}}) {
    std::vector<std::string> words{"make", path("phone.jpg"), "-o", path("c.palp")};
    words.insert(words.end(), wish.begin(), wish.end());
    const Outcome contours = palpable(words);
    ASSERT_EQ(contours.exit_code, 0) << contours.err;
    EXPECT_EQ(palpable({"info", path("c.palp"), "--json"}).json()["kind"], "contours");
  }
}

TEST_F(CameraFiles, APictureWithoutAPairIsNamed) {
  ASSERT_TRUE(formats::write_png(path("one.png"), pair_.left));
  const Outcome none = palpable({"info", path("one.png")});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_TRUE(is_one_sentence(none.err));
  EXPECT_THAT(none.err, HasSubstr("is a picture, and not a scene"));
  const Outcome alone = palpable({"depth", path("one.png"), "-o", path("d.pfm")});
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_TRUE(is_one_sentence(alone.err));
  EXPECT_THAT(alone.err, HasSubstr("give the right picture too"));
  write_text(path("cut.mpo"),
             sources::mpo(jpeg(pair_.left), jpeg(pair_.right), sources::kDisparity).substr(0, 40000));
  const Outcome cut = palpable({"depth", path("cut.mpo"), "-o", path("d.pfm")});
  EXPECT_EQ(cut.exit_code, 3);
  EXPECT_TRUE(is_one_sentence(cut.err));
  EXPECT_THAT(cut.err, HasSubstr("cut.mpo"));
}

}  // namespace
}  // namespace palpable::test
