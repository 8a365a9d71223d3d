// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/input/input.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/formats/packing/npz.hpp"
#include "palpable/formats/packing/zip.hpp"
#include "palpable/formats/picture/picture.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

namespace fs = std::filesystem;

class AnInput : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / (std::string("palpable-input-") +
                                              testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path text(const std::string& name, std::string_view content) {
    EXPECT_TRUE(write_file_atomically(folder_ / name, as_bytes(content)));
    return folder_ / name;
  }
  fs::path picture(const std::string& name) {
    EXPECT_TRUE(formats::write_png(folder_ / name, Raster<Rgb8>(4, 4)));
    return folder_ / name;
  }
  static std::string content(const fs::path& file) {
    const auto bytes = read_file(file);
    return bytes ? std::string(as_text(*bytes)) : std::string();
  }
  static std::string kind(std::vector<fs::path> paths, std::optional<InputKind> wanted = std::nullopt) {
    const auto input = recognise_input(paths, wanted);
    return input ? std::string(name_of(input->kind)) : input.error().sentence();
  }
  fs::path folder_;
};

/// A slope of depths in millimetres, all values different.
Raster<std::uint16_t> slope() {
  Raster<std::uint16_t> out(8, 8);
  for (std::size_t i = 0; i < out.count(); ++i) out.values()[i] = static_cast<std::uint16_t>(700 + 3 * i);
  return out;
}

TEST_F(AnInput, OfOneChannelAndSixteenBitsIsDepthAndSaysSo) {
  ASSERT_TRUE(formats::write_png(folder_ / "d.png", slope()));
  const std::vector<fs::path> one{folder_ / "d.png"};
  const auto input = recognise_input(one);
  ASSERT_TRUE(input);
  EXPECT_EQ(input->kind, InputKind::depth);
  ASSERT_EQ(input->notes.size(), 1U);
  EXPECT_EQ(input->notes[0].reason, Reason::photo_depth_used);
  EXPECT_EQ(kind(one, InputKind::picture), "picture");
}

TEST_F(AnInput, OfSixteenBitsThatWereEightIsAPictureAndSaysSo) {
  Raster<std::uint16_t> grey = slope();
  for (std::uint16_t& v : grey.values()) v = static_cast<std::uint16_t>((v % 256) * 257);
  ASSERT_TRUE(formats::write_png(folder_ / "g.png", grey));
  const auto input = recognise_input(std::vector<fs::path>{folder_ / "g.png"});
  ASSERT_TRUE(input);
  EXPECT_EQ(input->kind, InputKind::picture);
  ASSERT_EQ(input->notes.size(), 1U);
  EXPECT_EQ(input->notes[0].reason, Reason::unexpected_input_kind);
}

TEST_F(AnInput, ThatIsAnAnimatedPngSaysThatItsFirstPictureIsUsed) {
  const std::string still = content(picture("still.png"));
  // Signature and header, then acTL: two pictures, for ever. Its checksum (PNG, annex D) is that of an
  // encoder.
  constexpr std::size_t kHeaderEnd = 8 + 25;
  const std::string animation(
      "\0\0\0\x08"
      "acTL"
      "\0\0\0\x02"
      "\0\0\0\0"
      "\xF3\x8D\x93\x70",
      20);
  const fs::path moving =
      text("moving.png", still.substr(0, kHeaderEnd) + animation + still.substr(kHeaderEnd));
  const auto input = recognise_input(std::vector<fs::path>{moving});
  ASSERT_TRUE(input) << input.error().sentence();
  EXPECT_EQ(input->kind, InputKind::picture);
  ASSERT_EQ(input->notes.size(), 1U);
  EXPECT_NE(input->notes[0].sentence.find("the first was used"), std::string::npos);
  EXPECT_TRUE(recognise_input(std::vector<fs::path>{folder_ / "still.png"})->notes.empty());
}

TEST_F(AnInput, IsDepthWhereItsSidecarSaysSo) {
  text("g.pgm", "P5\n2 2\n255\nabcd");
  EXPECT_EQ(kind({folder_ / "g.pgm"}), "picture");
  text("g.pgm.json", R"({"meaning": "nearness"})");
  EXPECT_EQ(kind({folder_ / "g.pgm"}), "depth");
}

TEST_F(AnInput, IsRecognisedByContentNotByName) {
  fs::rename(picture("a.png"), folder_ / "a.mp4");
  EXPECT_EQ(kind({folder_ / "a.mp4"}), "picture");
  ASSERT_TRUE(formats::write_pfm(folder_ / "d.png", Raster<float>(2, 2, 1.0F)));
  EXPECT_EQ(kind({folder_ / "d.png"}), "depth");
  ASSERT_TRUE(formats::write_npz(folder_ / "d.npz", {{"a", formats::npy_array(1.0)}}));
  EXPECT_EQ(kind({folder_ / "d.npz"}), "depth");
  ASSERT_TRUE(write_file_atomically(folder_ / "s.txt", *formats::zip({{"scene.json", {}}, {"z.zst", {}}})));
  EXPECT_EQ(kind({folder_ / "s.txt"}), "scene");
  EXPECT_EQ(kind({text("m.bin", "<?xml version='1.0'?>\n<osm version=\"0.6\">")}), "map");
  EXPECT_EQ(kind({text("p.bin", std::string("\0\0\0\x0E\x0A\x09OSMHeader", 15))}), "map");
  EXPECT_EQ(kind({text("g", "glTF....")}), "mesh");
  EXPECT_EQ(kind({text("o", "# cube\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")}), "mesh");
  EXPECT_EQ(kind({text("q", "ply\nformat ascii 1.0\nelement vertex 3\nelement face 1\nend_header\n")}),
            "mesh");
  EXPECT_EQ(kind({text("r", "ply\nformat ascii 1.0\nelement vertex 3\nend_header\n")}), "points");
  EXPECT_EQ(kind({text("v", std::string("\0\0\0\x18"
                                        "ftypisom",
                                        12))}),
            "video");
  EXPECT_EQ(kind({text("stl", std::string(80, 'x') + std::string("\x01\0\0\0", 4) + std::string(50, '\0'))}),
            "mesh");
}

TEST_F(AnInput, OfTwoPicturesIsAStereoPairLeftFirst) {
  const auto left = picture("l.png");
  const auto right = picture("r.png");
  const auto input = recognise_input(std::vector{left, right});
  ASSERT_TRUE(input);
  EXPECT_EQ(input->kind, InputKind::stereo);
  EXPECT_EQ(input->files, (std::vector{left, right}));
}

TEST_F(AnInput, OfAPictureAndNumbersIsDepthWithThePictureFirst) {
  const auto colour = picture("c.png");
  ASSERT_TRUE(formats::write_pfm(folder_ / "d.pfm", Raster<float>(4, 4, 1.0F)));
  const auto input = recognise_input(std::vector{folder_ / "d.pfm", colour});
  ASSERT_TRUE(input);
  EXPECT_EQ(input->kind, InputKind::depth);
  EXPECT_EQ(input->files, (std::vector{colour, folder_ / "d.pfm"}));
  EXPECT_EQ(kind({colour, colour}, InputKind::depth), "depth");
}

TEST_F(AnInput, OfAPictureAndAGreyOneOfSixteenBitsIsDepthWithThePictureFirst) {
  const fs::path colour = picture("colour.png"), depth = folder_ / "depth.png", other = folder_ / "other.png";
  ASSERT_TRUE(formats::write_png(depth, slope()));
  ASSERT_TRUE(formats::write_png(other, slope()));
  for (const std::vector<fs::path>& files : {std::vector{colour, depth}, std::vector{depth, colour}}) {
    const auto input = recognise_input(files);
    ASSERT_TRUE(input) << input.error().sentence();
    EXPECT_EQ(input->kind, InputKind::depth);
    EXPECT_EQ(input->files, (std::vector{colour, depth}));
    EXPECT_EQ(input->notes.size(), 1U);
  }
  EXPECT_EQ(kind({depth, other}), "stereo");
  EXPECT_EQ(kind({colour, depth}, InputKind::stereo), "stereo");
}

TEST_F(AnInput, OfAFolderIsASequenceInTheOrderOfItsNumbers) {
  for (const char* name : {"f10.png", "f9.png", "f001.png"}) picture(name);
  text("readme.txt", "not a frame");
  const auto input = recognise_input(std::vector{folder_});
  ASSERT_TRUE(input) << input.error().sentence();
  EXPECT_EQ(input->kind, InputKind::video);
  EXPECT_EQ(input->files, (std::vector{folder_ / "f001.png", folder_ / "f9.png", folder_ / "f10.png"}));
  fs::remove(folder_ / "f9.png");
  fs::remove(folder_ / "f10.png");
  EXPECT_FALSE(recognise_input(std::vector{folder_}));
  EXPECT_FALSE(recognise_input(std::vector{folder_}, InputKind::scene));
}

TEST_F(AnInput, OfAFolderNamesThePicturesThatCannotBeRead) {
  for (const char* name : {"f1.png", "f2.png", "f4.png"}) picture(name);
  text("f3.png", "no picture");
  const auto one = recognise_input(std::vector{folder_});
  ASSERT_TRUE(one);
  ASSERT_EQ(one->notes.size(), 1U);
  EXPECT_EQ(one->notes[0].sentence, "f3.png was left out: it is not a readable picture.");
  text("f10.JPG", "");
  text("readme.txt", "not a frame");
  const auto two = recognise_input(std::vector{folder_});
  ASSERT_TRUE(two);
  EXPECT_EQ(two->files.size(), 3U);
  ASSERT_EQ(two->notes.size(), 1U);
  EXPECT_EQ(two->notes[0].sentence, "f3.png and 1 more were left out: they are not readable pictures.");
}

TEST_F(AnInput, CanBeCalledSomethingElse) {
  EXPECT_EQ(kind({picture("d.png")}, InputKind::depth), "depth");
  EXPECT_EQ(kind({picture("sbs.png")}, InputKind::stereo), "stereo");
  EXPECT_EQ(kind({picture("street.png")}, InputKind::map), "map");
}

TEST_F(AnInput, ThatIsNothingKnownIsRefusedWithASentence) {
  EXPECT_EQ(kind({text("a.png", "milk, bread")}),
            (folder_ / "a.png").string() + ": is a text file, not a picture");
  EXPECT_NE(kind({folder_ / "none"}).find("No such file"), std::string::npos);
  EXPECT_NE(kind({text("e", "")}).find("is empty"), std::string::npos);
  EXPECT_EQ(kind({}), "no input is named");
  EXPECT_NE(kind({picture("a2.png"), text("t", "hello")}).find("t: is a text file"), std::string::npos);
  ASSERT_TRUE(write_file_atomically(folder_ / "z.palp", *formats::zip({{"other", {}}})));
  EXPECT_NE(kind({folder_ / "z.palp"}).find("neither a scene nor a NumPy file"), std::string::npos);
}

TEST_F(AnInput, NamesItsKindsBothWays) {
  for (const char* name : {"picture", "stereo", "depth", "video", "map", "mesh", "points", "scene"})
    EXPECT_EQ(name_of(*input_kind_from(name)), name);
  EXPECT_FALSE(input_kind_from("pictures"));
}

TEST_F(AnInput, OfRealFilesIsRecognised) {
  const char* data = std::getenv("PALPABLE_DATA");
  if (data == nullptr) GTEST_SKIP() << "PALPABLE_DATA is not set";
  const fs::path root(data);
  const auto expect_all = [](const fs::path& folder, const char* extension, const char* expected) {
    int seen = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() != extension) continue;
      EXPECT_EQ(kind({entry.path()}), expected) << entry.path();
      if (++seen == 20) break;
    }
    EXPECT_GT(seen, 0) << folder << extension;
  };
  expect_all(root / "contour", ".jpg", "picture");
  expect_all(root / "mesh", ".glb", "mesh");
  expect_all(root / "mesh", ".obj", "mesh");
  expect_all(root / "mesh/touchmapper_map", ".osm", "map");
  expect_all(root / "map-vector", ".pbf", "map");
  expect_all(root / "stereo", ".pfm", "depth");
  expect_all(root / "stereo", ".npz", "depth");
  expect_all(root / "stereo", ".png", "picture");
}

}  // namespace
}  // namespace palpable::sources
