// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/packing/zip.hpp"

#include <cmath>
#include <csignal>
#include <random>
#include <span>
#include <sstream>

#include "program.hpp"
#include "test_pictures.hpp"
#include <gmock/gmock.h>

namespace palpable::test {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kTwoBalls =
    R"({"primitives": [{"size_m": [0.01, 0.01, 0.01], "exponents": [1, 1], "position_m": [0, 0, 0]},
    {"size_m": [0.01, 0.01, 0.01], "exponents": [1, 1], "rotation": [0.9238795, 0, 0.3826834, 0],
     "position_m": [0.025, 0, 0]}]})";

class FieldCommands : public InFolder {
 protected:
  /// The distances of the scene at a list of places, each "x,y,z".
  std::vector<double> distances(const std::string& scene, const std::vector<std::string>& places) const {
    std::string csv = "x_m,y_m,z_m\n";
    for (const auto& place : places) csv += place + "\n";
    write_text(path("places.csv"), csv);
    const Outcome outcome =
        palpable({"sample", scene, "--points", path("places.csv"), "-o", path("values.csv")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    std::istringstream lines(read_text(path("values.csv")));
    std::vector<double> values;
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      std::istringstream cells(line);
      std::string cell;
      for (int k = 0; k < 4; ++k) std::getline(cells, cell, ',');
      values.push_back(std::stod(cell));
    }
    return values;
  }
};

TEST_F(FieldCommands, SuperquadricsBecomeAFieldThatIsExportedAsAMesh) {
  write_text(path("shapes.json"), kTwoBalls);
  const Outcome made =
      palpable({"make", path("shapes.json"), "-o", path("s.palp"), "--resolution", "32", "--json"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.json()["kind"], "field");
  const auto d = distances(path("s.palp"), {"0,0,0.011", "0,0.008,0", "-0.0102,0,0"});
  ASSERT_EQ(d.size(), 3U);
  EXPECT_NEAR(d[0], 0.001, 1e-4);
  EXPECT_NEAR(d[1], -0.002, 1e-4);
  EXPECT_NEAR(d[2], 0.0002, 1e-4);
  for (const char* name : {"s.stl", "s.ply", "s.glb"}) {
    const Outcome exported = palpable({"export", path("s.palp"), "-o", path(name), "--json"});
    ASSERT_EQ(exported.exit_code, 0) << exported.err;
    EXPECT_GT(exported.json()["triangles"], 200);
  }
  // Seen from its front, as a drawing on A4, in dots and on pins.
  ASSERT_EQ(palpable({"export", path("s.palp"), "-o", path("s.svg")}).exit_code, 0);
  EXPECT_THAT(read_text(path("s.svg")), AllOf(HasSubstr("297.000mm"), HasSubstr("<path d=\"M")));
  ASSERT_EQ(palpable({"export", path("s.palp"), "-o", path("s.brf")}).exit_code, 0);
  EXPECT_THAT(read_text(path("s.brf")), HasSubstr("\f"));
  ASSERT_EQ(palpable({"export", path("s.palp"), "-o", path("s.pbm")}).exit_code, 0);
  EXPECT_THAT(read_text(path("s.pbm")), HasSubstr("11"));
  // The exported mesh is closed and represents the same solid.
  const Outcome again =
      palpable({"make", path("s.ply"), "-o", path("t.palp"), "--resolution", "32", "--json"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  // No repair was needed; facets may have been rounded, and the field's greatest error is reported.
  for (const auto& note : again.json()["notes"])
    EXPECT_THAT(note.get<std::string>(),
                AnyOf(HasSubstr("small facets"), HasSubstr("error near the surface is at most")));
  EXPECT_THAT(again.err, HasSubstr("error near the surface is at most"));
  EXPECT_NEAR(distances(path("t.palp"), {"0,0,0.011"})[0], 0.001, 3e-4);
}

TEST_F(FieldCommands, PointsWithNormalsBecomeAField) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  constexpr int kPoints = 800;
  const auto ply = [&](const std::string& properties, bool normals) {
    std::ostringstream text;
    text << "ply\nformat ascii 1.0\nelement vertex " << kPoints
         << "\nproperty float x\nproperty float y\nproperty float z\n"
         << properties << "end_header\n";
    for (int i = 0; i < kPoints; ++i) {
      double x = normal(random), y = normal(random), z = normal(random);
      const double length = std::sqrt(x * x + y * y + z * z);
      x /= length, y /= length, z /= length;
      text << 0.02 * x << " " << 0.02 * y << " " << 0.02 * z;
      if (normals) text << " " << x << " " << y << " " << z;
      text << "\n";
    }
    return text.str();
  };
  write_text(path("ball.ply"), ply("property float nx\nproperty float ny\nproperty float nz\n", true));
  const Outcome made = palpable({"make", path("ball.ply"), "-o", path("b.palp"), "--resolution", "32"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto d = distances(path("b.palp"), {"0,0,0.021", "0.015,0,0"});
  EXPECT_NEAR(d[0], 0.001, 5e-4);
  EXPECT_NEAR(d[1], -0.005, 5e-4);

  write_text(path("bare.ply"), ply("", false));
  const Outcome bare = palpable({"make", path("bare.ply"), "-o", path("n.palp"), "--resolution", "32"});
  ASSERT_EQ(bare.exit_code, 0) << bare.err;
  EXPECT_THAT(bare.err, HasSubstr("normals"));
  EXPECT_NEAR(distances(path("n.palp"), {"0,0,0.021"})[0], 0.001, 5e-4);
}

TEST_F(FieldCommands, APairBecomesTheVolumeBehindIt) {
  write_pair(folder_.string(), textured_pair());
  const Outcome made = palpable({"make", path("left.png"), path("right.png"), "-o", path("p.palp"), "--as",
                                 "field", "--method", "fast", "--resolution", "24", "--json"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.json()["kind"], "field");
  const auto d = distances(path("p.palp"), {"0,0,0.017", "0,0,-0.001"});
  EXPECT_GT(d[0], 0.0);
  EXPECT_LT(d[1], 0.0);
}

/// The upper half of a ball as an open surface (OBJ), 3 mm wide quads cut into triangles.
std::string half_ball(double radius_m) {
  constexpr int kRings = 16, kAround = 48;
  std::ostringstream text;
  for (int i = 0; i <= kRings; ++i)
    for (int k = 0; k < kAround; ++k) {
      const double polar = 0.5 * 3.14159265 * i / kRings, turn = 2.0 * 3.14159265 * k / kAround;
      text << "v " << radius_m * std::sin(polar) * std::cos(turn) << " "
           << radius_m * std::sin(polar) * std::sin(turn) << " " << radius_m * std::cos(polar) << "\n";
    }
  for (int i = 0; i < kRings; ++i)
    for (int k = 0; k < kAround; ++k) {
      const int a = 1 + kAround * i + k, b = 1 + kAround * i + (k + 1) % kAround;
      text << "f " << a << " " << a + kAround << " " << b + kAround << "\n";
      if (i > 0) text << "f " << a << " " << b + kAround << " " << b << "\n";
    }
  return text.str();
}

TEST_F(FieldCommands, CorrectsAFieldByAMeasuredSurface) {
  write_text(
      path("ball.json"),
      R"({"primitives": [{"size_m": [0.02, 0.02, 0.02], "exponents": [1, 1], "position_m": [0, 0, 0]}]})");
  ASSERT_EQ(palpable({"make", path("ball.json"), "-o", path("b.palp"), "--resolution", "32"}).exit_code, 0);
  write_text(path("measured.obj"), half_ball(0.021));
  const Outcome corrected = palpable(
      {"correct", path("b.palp"), path("measured.obj"), "-o", path("c.palp"), "--transition", "6", "--json"});
  ASSERT_EQ(corrected.exit_code, 0) << corrected.err;
  EXPECT_GT(corrected.json()["measured_samples"], 50);
  const auto d = distances(path("c.palp"), {"0,0,0.0215", "0.014,0,0.013", "0,0,-0.0205", "0,0.015,-0.015"});
  EXPECT_NEAR(d[0], 0.0005, 1e-4);
  EXPECT_NEAR(d[1], 0.019105 - 0.021, 1e-4);
  EXPECT_NEAR(d[2], 0.0005, 1e-4);
  EXPECT_NEAR(d[3], 0.0212132 - 0.02, 1e-4);

  // Too deep for the volume around the measured surface, unless requested.
  const std::string deep = "0,0,0.011";
  EXPECT_NEAR(distances(path("c.palp"), {deep})[0], distances(path("b.palp"), {deep})[0], 1e-5);
  ASSERT_EQ(palpable({"correct", path("b.palp"), path("measured.obj"), "-o", path("e.palp"), "--everywhere"})
                .exit_code,
            0);
  EXPECT_NEAR(distances(path("e.palp"), {deep})[0], 0.011 - 0.021, 2e-4);

  write_text(path("elsewhere.obj"), half_ball(0.2));
  const Outcome missed = palpable({"correct", path("b.palp"), path("elsewhere.obj"), "-o", path("x.palp")});
  EXPECT_EQ(missed.exit_code, 1);
  EXPECT_TRUE(is_one_sentence(missed.err)) << missed.err;
  EXPECT_THAT(missed.err, HasSubstr("elsewhere.obj"));
  EXPECT_FALSE(std::filesystem::exists(path("x.palp")));
}

TEST_F(FieldCommands, BadSolidsAreRefusedInOneSentence) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"empty.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"},
      {"line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"},
      {"exponent.json",
       R"({"primitives": [{"size_m": [1, 1, 1], "exponents": [0, 1], "position_m": [0, 0, 0]}]})"},
      {"size.json",
       R"({"primitives": [{"size_m": [1, -1, 1], "exponents": [1, 1], "position_m": [0, 0, 0]}]})"},
      {"none.json", R"({"primitives": []})"},
      {"halfaxes.json", R"({"primitives": [{"exponents": [1, 1], "position_m": [0, 0, 0]}]})"},
      {"shape.json", R"({"primitives": 7})"},
      {"plane.ply",
       "ply\nformat ascii 1.0\nelement vertex 16\nproperty float x\nproperty float y\nproperty float z\n"
       "property float nx\nproperty float ny\nproperty float nz\nend_header\n"
       "0 0 0 0 0 1\n1 0 0 0 0 1\n2 0 0 0 0 1\n3 0 0 0 0 1\n0 1 0 0 0 1\n1 1 0 0 0 1\n2 1 0 0 0 1\n3 1 0 0 0 "
       "1\n"
       "0 2 0 0 0 1\n1 2 0 0 0 1\n2 2 0 0 0 1\n3 2 0 0 0 1\n0 3 0 0 0 1\n1 3 0 0 0 1\n2 3 0 0 0 1\n3 3 0 0 0 "
       "1\n"}};
  for (const auto& [name, text] : cases) {
    write_text(path(name), text);
    const Outcome outcome =
        palpable({"make", path(name), "--as", "field", "-o", path("x.palp"), "--resolution", "32"});
    EXPECT_EQ(outcome.exit_code, 3) << name << ": " << outcome.err;
    EXPECT_TRUE(is_one_sentence(outcome.err)) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(name));
    EXPECT_THAT(outcome.err, Not(HasSubstr("exception"))) << name;
    EXPECT_FALSE(std::filesystem::exists(path("x.palp"))) << name;
  }
}

TEST_F(FieldCommands, RefusesASceneWhoseFieldIsDamagedInOneSentence) {
  write_text(path("shapes.json"), kTwoBalls);
  ASSERT_EQ(palpable({"make", path("shapes.json"), "-o", path("s.palp"), "--resolution", "16"}).exit_code, 0);
  const std::string file = read_text(path("s.palp"));
  const auto whole = formats::unzip(std::as_bytes(std::span(file.data(), file.size())));
  ASSERT_TRUE(whole);
  constexpr const char* kCells = "cells.field.zst";
  const std::size_t size = whole->at(kCells).size();
  const auto damaged = [&](const formats::Bytes& cells) {
    formats::ZipMembers members = *whole;
    members[kCells] = cells;
    const auto bytes = formats::zip(members);
    EXPECT_TRUE(bytes);
    write_text(path("d.palp"), {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    return palpable({"info", path("d.palp")});
  };
  formats::Bytes cut = whole->at(kCells);
  cut.resize(size / 2);
  formats::Bytes other = whole->at(kCells);
  for (std::size_t i = size / 3; i < size / 3 + 32; ++i) other[i] = std::byte{0xA5};
  for (const formats::Bytes& cells : {cut, other, formats::Bytes{}}) {
    const Outcome outcome = damaged(cells);
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_TRUE(is_one_sentence(outcome.err)) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("d.palp"));
  }
}

TEST_F(FieldCommands, CtrlCStopsABuildAndLeavesNoIncompleteFile) {
  write_text(path("shapes.json"), kTwoBalls);
  // Sampling takes minutes. Reading two small shapes takes less than 0.1 s, so after one second of processor
  // time the program samples cells.
  Running running(
      {"make", path("shapes.json"), "-o", path("s.palp"), "--resolution", "2048", "--max-error", "0.001"});
  ASSERT_TRUE(running.works(std::chrono::seconds(1), std::chrono::seconds(60)));
  running.send(SIGINT);
  const Outcome outcome = running.wait(std::chrono::seconds(30));
  EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  EXPECT_TRUE(is_one_sentence(outcome.err));
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("s.palp"))) << "left behind";
}

}  // namespace
}  // namespace palpable::test
