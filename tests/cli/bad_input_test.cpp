// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/picture/picture.hpp"

#include <csignal>
#include <cstdint>
#include <limits>

#include "program.hpp"
#include "test_pictures.hpp"
#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

namespace palpable::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class BadInput : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    write_pair(folder_.string(), textured_pair());
  }
  Outcome make_pair(const std::string& left, const std::string& right) {
    return palpable({"make", path(left), path(right), "-o", path("out.palp")});
  }
  /// Refused with exit code 3 and one sentence that names the file; nothing is written.
  void expect_refused(const Outcome& outcome, const std::string& file, const std::string& reason = "") {
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_TRUE(is_one_sentence(outcome.err));
    EXPECT_THAT(outcome.err, HasSubstr(file));
    EXPECT_THAT(outcome.err, HasSubstr(reason));
    EXPECT_THAT(outcome.err, Not(HasSubstr("bug")));
    EXPECT_FALSE(std::filesystem::exists(path("out.palp")));
  }
};

/// A PNG that states this size but has only a header.
std::string png_of_size(std::uint32_t width, std::uint32_t height) {
  std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  for (const std::uint32_t side : {width, height})
    for (int shift = 24; shift >= 0; shift -= 8)
      png += static_cast<char>(side >> static_cast<unsigned>(shift));
  return png + std::string("\x08\x02\0\0\0\0\0\0\0", 9);
}

TEST_F(BadInput, AMissingFileIsNamed) {
  expect_refused(make_pair("left.png", "none.png"), "none.png", "No such file");
  expect_refused(palpable({"info", path("none.palp")}), "none.palp");
  expect_refused(palpable({"probe", path("none.palp"), "--path", path("p.csv"), "-o", path("f.csv")}),
                 "none.palp");
}

TEST_F(BadInput, AScenePipeOrFolderIsRefusedAtOnce) {
  ASSERT_EQ(mkfifo(path("pipe.palp").c_str(), 0600), 0);
  expect_refused(palpable({"info", path("pipe.palp")}), "pipe.palp", "is not a regular file");
  expect_refused(palpable({"check", path("pipe.palp")}), "pipe.palp", "is not a regular file");
  expect_refused(palpable({"touch", path("left.png"), path("right.png"), "--headless", "--device",
                           "replay:" + path("pipe.palp"), "--quiet"}),
                 "pipe.palp", "is not a regular file");
  expect_refused(palpable({"info", folder_.string()}), folder_.string(), "is a folder, and not a scene");
}

TEST_F(BadInput, APipeInPlaceOfAPictureOrVideoIsRefusedAtOnce) {
  for (const char* name : {"pipe.png", "pipe.mp4"}) {
    ASSERT_EQ(mkfifo(path(name).c_str(), 0600), 0);
    expect_refused(palpable({"make", path(name), "-o", path("out.palp")}), name, "is a pipe");
  }
}

TEST_F(BadInput, APictureIsNoMapExtract) {
  expect_refused(palpable({"make", path("left.png"), "--kind", "map", "-o", path("out.palp")}), "left.png",
                 "is not a map extract");
}

TEST_F(BadInput, APictureInPlaceOfAMeshIsNamedAsOne) {
  ASSERT_EQ(palpable({"make", path("left.png"), "-o", path("lines.palp")}).exit_code, 0);
  expect_refused(palpable({"correct", path("lines.palp"), path("left.png"), "-o", path("out.palp")}),
                 "left.png", "is a picture, and not a mesh");
}

TEST_F(BadInput, ATextFileNamedPngIsRefused) {
  write_text(path("text.png"), "This text is not a picture.\n");
  expect_refused(make_pair("text.png", "right.png"), "text.png");
  expect_refused(palpable({"depth", path("left.png"), path("text.png"), "-o", path("d.pfm")}), "text.png");
}

TEST_F(BadInput, ARecordingIsNoScene) {
  write_text(path("touch.rec"), "PALPREC1 and more");
  expect_refused(palpable({"info", path("touch.rec")}), "touch.rec", "recording of a touch");
}

TEST_F(BadInput, AFolderOfManyPicturesIsNamedByItsFirst) {
  std::filesystem::create_directory(path("many"));
  for (int i = 0; i < 12; ++i)
    std::filesystem::copy_file(path("left.png"), path("many/" + std::to_string(100 + i) + ".png"));
  const Outcome outcome = palpable({"make", path("many"), "-o", path("out.palp")});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("100.png and 11 more"));
  EXPECT_THAT(outcome.err, HasSubstr("the camera did not move"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("111.png")));
}

TEST_F(BadInput, ATruncatedPictureIsRefused) {
  const std::string whole = read_text(path("left.png"));
  write_text(path("cut.png"), whole.substr(0, whole.size() / 2));
  expect_refused(make_pair("cut.png", "right.png"), "cut.png");
}

TEST_F(BadInput, APictureOfOnePixelIsTooSmall) {
  ASSERT_TRUE(formats::write_png(path("one.png"), Raster<Rgb8>(1, 1, {9, 9, 9})));
  expect_refused(make_pair("one.png", "one.png"), "one.png");
  expect_refused(palpable({"make", path("one.png"), "--kind", "depth", "-o", path("out.palp")}), "one.png");
}

TEST_F(BadInput, AHugePictureIsRefusedBeforeAllocation) {
  write_text(path("huge.png"), png_of_size(20000, 20000));
  expect_refused(make_pair("huge.png", "huge.png"), "huge.png");
}

TEST_F(BadInput, PicturesOfDifferentSizeAreRefused) {
  ASSERT_TRUE(formats::write_png(path("small.png"), unrelated_picture(100, 80, 3)));
  expect_refused(make_pair("left.png", "small.png"), "small.png", "160 x 120");
}

TEST_F(BadInput, UnrelatedPicturesAreMatchedWithAWarningAndAFigure) {
  ASSERT_TRUE(formats::write_png(path("other.png"), unrelated_picture(160, 120, 99)));
  const Outcome outcome =
      palpable({"make", path("left.png"), path("other.png"), "-o", path("out.palp"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  ASSERT_FALSE(outcome.json()["notes"].empty());
  EXPECT_THAT(outcome.err, HasSubstr("%"));
  EXPECT_THAT(outcome.err, HasSubstr(outcome.json()["notes"][0].get<std::string>()));
}

TEST_F(BadInput, AnAllBlackPairEndsWithASentence) {
  ASSERT_TRUE(formats::write_png(path("black.png"), Raster<Rgb8>(160, 120)));
  const Outcome outcome = make_pair("black.png", "black.png");
  EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.err;
  EXPECT_THAT(outcome.err, Not(HasSubstr("bug")));
  EXPECT_NE(outcome.err, "") << "no message about a pair without texture";
}

TEST_F(BadInput, NanAndNegativeDepthAreUnknown) {
  Raster<float> depth(40, 30, 1.0F);
  for (int x = 0; x < 40; ++x) depth(x, 3) = std::numeric_limits<float>::quiet_NaN();
  for (int x = 0; x < 40; ++x) depth(x, 4) = -2.0F;
  for (int x = 0; x < 20; ++x) depth(x, 20) = 0.8F;
  ASSERT_TRUE(formats::write_pfm(path("depth.pfm"), depth));
  EXPECT_EQ(palpable({"make", path("depth.pfm"), "--kind", "depth", "-o", path("good.palp")}).exit_code, 0);
  const Outcome plain =
      palpable({"make", path("depth.pfm"), "--kind", "depth", "-o", path("good.palp"), "--ground", "remove"});
  EXPECT_EQ(plain.exit_code, 0);
  EXPECT_THAT(plain.err, testing::HasSubstr("No ground was found"));
  for (float& d : depth.values()) d = std::numeric_limits<float>::quiet_NaN();
  ASSERT_TRUE(formats::write_pfm(path("nan.pfm"), depth));
  expect_refused(palpable({"make", path("nan.pfm"), "--kind", "depth", "-o", path("out.palp")}), "nan.pfm");
}

TEST_F(BadInput, ASceneDamagedAnywhereIsRefused) {
  ASSERT_EQ(palpable({"make", path("left.png"), path("right.png"), "-o", path("good.palp")}).exit_code, 0);
  const std::string whole = read_text(path("good.palp"));
  for (const double part : {0.0, 0.1, 0.5, 0.9, 0.999}) {
    write_text(path("cut.palp"),
               whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
    expect_refused(palpable({"info", path("cut.palp")}), "cut.palp");
  }
  std::string flipped = whole;
  for (std::size_t i = 200; i < flipped.size(); i += 997) flipped[i] = static_cast<char>(flipped[i] ^ 0x55);
  write_text(path("flipped.palp"), flipped);
  expect_refused(palpable({"info", path("flipped.palp")}), "flipped.palp");
}

TEST_F(BadInput, APathThatCannotBeWrittenIsNamed) {
  const Outcome outcome =
      palpable({"make", path("left.png"), path("right.png"), "-o", path("no/folder/out.palp")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(is_one_sentence(outcome.err));
  EXPECT_THAT(outcome.err, HasSubstr("no/folder"));
}

TEST_F(BadInput, AnOutputThatIsAnInputIsRefusedAndKept) {
  const std::string left = path("left.png"), before = read_text(left);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"depth", left, path("right.png"), "-o", left},
        {"rectify", left, "-o", left},
        {"fit", path("right.png"), left, "-o", left},
        {"touch", left, path("right.png"), "--headless", "--seconds", "1", "--record", left}}) {
    const Outcome outcome = palpable(words);
    EXPECT_EQ(outcome.exit_code, 2) << words.front();
    EXPECT_TRUE(is_one_sentence(outcome.err)) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("is also an input"));
    EXPECT_EQ(read_text(left), before) << words.front();
  }
}

/// Writes a depth map of a slope as 16-bit PNG.
void write_slope(const std::string& file) {
  Raster<std::uint16_t> depth_mm(32, 24);
  for (int y = 0; y < depth_mm.height(); ++y)
    for (int x = 0; x < depth_mm.width(); ++x) depth_mm(x, y) = static_cast<std::uint16_t>(1000 + x + y);
  ASSERT_TRUE(formats::write_png(file, depth_mm));
}

TEST_F(BadInput, AnOutputThatIsAFileBesideAnInputIsRefusedAndKept) {
  std::filesystem::create_directories(path("frames"));
  write_slope(path("frames/0.depth.png"));
  write_slope(path("d.png"));
  write_text(path("frames/0.pose.txt"), "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  write_text(path("frames/intrinsics.K.txt"), "30 0 15.5\n0 30 11.5\n0 0 1\n");
  write_text(path("d.json"), "{}");
  write_text(path("frames/depth.json"), R"({"scale": 0.001})");
  std::filesystem::create_symlink("frames/0.pose.txt", path("link"));
  const std::string live = "frames:" + path("frames") + "?loop=1";
  const auto refused = [&](const std::vector<std::string>& words, const std::string& file) {
    const std::string before = read_text(path(file));
    const Outcome outcome = palpable(words);
    EXPECT_EQ(outcome.exit_code, 2) << file << ": " << outcome.err;
    EXPECT_TRUE(is_one_sentence(outcome.err)) << outcome.err;
    EXPECT_EQ(read_text(path(file)), before) << file;
  };
  for (const char* file : {"frames/0.depth.png", "frames/0.pose.txt", "frames/intrinsics.K.txt",
                           "frames/depth.json", "link", "frames/../frames/0.depth.png"})
    refused({"touch", live, "--headless", "--seconds", "0.1", "--record", path(file)}, file);
  refused({"fit-shapes", path("d.png"), "-o", path("d.json")}, "d.json");

  ASSERT_EQ(palpable({"touch", live, "--headless", "--seconds", "0.2", "--record", path("a.rec")}).exit_code,
            0);
  for (const char* options : {"", "?", "?loop=1"})
    refused({"touch", path("d.png"), "--kind", "depth", "--headless", "--seconds", "0.1", "--device",
             "replay:" + path("a.rec") + options, "--record", path("a.rec")},
            "a.rec");
}

TEST_F(BadInput, CtrlCEndsACommandThatWaitsForAPipe) {
  const std::string pipe = path("pipe.json");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  Running running(
      {"make", path("left.png"), path("right.png"), "--calibration", pipe, "-o", path("out.palp")});
  ASSERT_TRUE(running.catches(SIGINT, std::chrono::seconds(60)));
  running.send(SIGINT);
  const Outcome outcome = running.wait(std::chrono::seconds(20));
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_TRUE(is_one_sentence(outcome.err)) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(path("out.palp")));
}

TEST_F(BadInput, CtrlCEndsAProbeWhoseWriterStaysSilent) {
  ASSERT_EQ(palpable({"make", path("left.png"), path("right.png"), "-o", path("scene.palp")}).exit_code, 0);
  const std::string pipe = path("path.csv");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  // Opened for both directions, it waits for no reader. First nothing is written, then a part of a line.
  const int writer = open(pipe.c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_GE(writer, 0);
  for (const std::string text : {"", "t_s,x_m"}) {
    ASSERT_EQ(write(writer, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    Running running({"probe", path("scene.palp"), "--path", pipe, "-o", path("forces.csv")});
    ASSERT_TRUE(running.catches(SIGINT, std::chrono::seconds(60)));
    running.send(SIGINT);
    // The program is silent until then and waits without end.
    const Outcome outcome = running.wait(std::chrono::seconds(20));
    EXPECT_EQ(outcome.exit_code, 130) << text;
    EXPECT_TRUE(is_one_sentence(outcome.err)) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(path("forces.csv")));
  }
  close(writer);
}

TEST_F(BadInput, KillingTheProgramAtAnyTimeKeepsTheOldFile) {
  ASSERT_EQ(palpable({"make", path("left.png"), path("right.png"), "-o", path("scene.palp")}).exit_code, 0);
  const std::string before = read_text(path("scene.palp"));
  for (int delay_ms = 0; delay_ms < 200; delay_ms += 12) {
    Running running(
        {"make", path("left.png"), path("right.png"), "-o", path("scene.palp"), "--size", "90x90x20"});
    usleep(static_cast<unsigned>(delay_ms) * 1000U);
    running.send(SIGKILL);
    static_cast<void>(running.wait());
    const std::string after = read_text(path("scene.palp"));
    if (after != before) {
      EXPECT_EQ(palpable({"info", path("scene.palp")}).exit_code, 0) << "killed after " << delay_ms << " ms";
    }
  }
}

TEST_F(BadInput, CtrlCEndsWith130AndLeavesNoIncompleteFile) {
  const auto big = textured_pair(900, 700);
  write_pair(folder_.string(), big);
  Running running({"depth", path("left.png"), path("right.png"), "-o", path("d.pfm")});
  // The work takes seconds and begins after the handler is installed.
  ASSERT_TRUE(running.catches(SIGINT, std::chrono::seconds(60)));
  running.send(SIGINT);
  const Outcome outcome = running.wait();
  EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  EXPECT_TRUE(is_one_sentence(outcome.err));
  EXPECT_FALSE(std::filesystem::exists(path("d.pfm")));
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("d.pfm."))) << "left behind";
}

// The program once checked its outputs before it ignored SIGXFSZ, and ended by it without a word.
TEST_F(BadInput, AFileSizeLimitIsOneSentence) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit limited = before;
  limited.rlim_cur = 1024;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limited), 0);
  Running running({"marker", "-o", path("sheet.pdf")});
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  const Outcome outcome = running.wait();
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(is_one_sentence(outcome.err)) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("sheet.pdf: cannot be written: File too large"));
  EXPECT_FALSE(std::filesystem::exists(path("sheet.pdf")));
}

// The servo's threads had as little stack as the system gave the program, and the touch ended by SIGSEGV.
TEST_F(BadInput, ASmallStackIsEnoughForATouch) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_STACK, &before), 0);
  rlimit limited = before;
  limited.rlim_cur = 112 << 10;
  ASSERT_EQ(setrlimit(RLIMIT_STACK, &limited), 0);
  Running running({"touch", "sample:church", "--headless", "--seconds", "0.2", "--resolution", "48"});
  ASSERT_EQ(setrlimit(RLIMIT_STACK, &before), 0);
  const Outcome outcome = running.wait();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_F(BadInput, APortInUseIsReported) {
  const int taken = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(bind(taken, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(listen(taken, 1), 0);
  socklen_t size = sizeof address;
  getsockname(taken, reinterpret_cast<sockaddr*>(&address), &size);
  const std::string port = std::to_string(ntohs(address.sin_port));
  const Outcome outcome =
      palpable({"touch", path("left.png"), path("right.png"), "--port", port, "--no-browser", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(is_one_sentence(outcome.err));
  EXPECT_THAT(outcome.err, HasSubstr(port));
  close(taken);
}

}  // namespace
}  // namespace palpable::test
