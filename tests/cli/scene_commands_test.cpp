// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "made_scene.hpp"
#include "program.hpp"
#include "test_pictures.hpp"
#include <gmock/gmock.h>

namespace palpable::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

/// Lengths in millimetres of the paths of an SVG that consist of straight lines, "M1.0 2.0L3.0 4.0".
std::vector<double> path_lengths_mm(const std::string& svg) {
  std::vector<double> lengths;
  for (std::size_t at = svg.find(" d=\"M"); at != std::string::npos; at = svg.find(" d=\"M", at + 1)) {
    std::istringstream points(svg.substr(at + 5, svg.find('"', at + 5) - at - 5));
    double x = 0.0, y = 0.0, length = 0.0;
    char line = '\0';
    points >> x >> y;
    for (double u = 0.0, v = 0.0; points >> line >> u >> v; x = u, y = v) length += std::hypot(u - x, v - y);
    lengths.push_back(length);
  }
  return lengths;
}

class SceneCommands : public MadeScene {};

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> fields;
    std::istringstream cells(line + ",");
    for (std::string cell; std::getline(cells, cell, ',');) fields.push_back(cell);
    rows.push_back(fields);
  }
  return rows;
}

TEST_F(SceneCommands, MakeReportsItsResult) {
  const auto json = made.json();
  EXPECT_EQ(json["kind"], "relief");
  EXPECT_NEAR(json["size_m"][0], 0.1, 1e-9);
  EXPECT_NEAR(json["size_m"][1], 0.075, 1e-9);
  EXPECT_TRUE(std::filesystem::exists(in("a.palp")));
}

TEST_F(SceneCommands, SwellPaperOfAReliefWithoutAGroundHasNoLinesThatAreTooShort) {
  // A dome with specks of 2 x 2 pixels: rings of about 3 mm around each of them.
  std::string picture = "P2 200 150 255\n";
  for (int y = 0; y < 150; ++y)
    for (int x = 0; x < 200; ++x) {
      const double r2 = (std::pow(x - 100.0, 2) + std::pow(y - 75.0, 2)) / 4000.0;
      const bool is_speck = x % 10 < 2 && y % 10 < 2;
      picture += std::to_string(static_cast<int>(200.0 * std::exp(-r2)) + (is_speck ? 40 : 0)) + "\n";
    }
  write_text(in("dome.pgm"), picture);
  const Outcome dome = palpable({"make", in("dome.pgm"), "--kind", "depth", "--depth-as", "disparity",
                                 "--detail", "linear", "-o", in("dome.palp")});
  ASSERT_EQ(dome.exit_code, 0) << dome.err;
  ASSERT_EQ(palpable({"export", in("dome.palp"), "-o", in("dome.svg"), "--interval", "1"}).exit_code, 0);
  const auto lengths = path_lengths_mm(read_text(in("dome.svg")));
  ASSERT_GE(lengths.size(), 3U);
  EXPECT_GE(*std::min_element(lengths.begin(), lengths.end()), 6.0);
}

TEST_F(SceneCommands, InfoHasAllDocumentedFields) {
  const auto json = palpable({"info", in("a.palp"), "--json"}).json();
  for (const char* field :
       {"format", "kind", "size_m", "scene_from_input", "memory_bytes", "file_bytes", "source", "materials"})
    EXPECT_TRUE(json.contains(field)) << field;
  EXPECT_EQ(json["file_bytes"], std::filesystem::file_size(in("a.palp")));
  EXPECT_THAT(json["scene_from_input"], SizeIs(4));
  EXPECT_THAT(json["scene_from_input"][3], ElementsAre(0.0, 0.0, 0.0, 1.0));
  // The picture's middle is at the scene's origin, and its rows run downwards.
  const auto& m = json["scene_from_input"];
  EXPECT_NEAR(m[0][0].get<double>() * 79.5 + m[0][3].get<double>(), 0.0, 1e-9);
  EXPECT_LT(m[1][1], 0.0);
}

TEST_F(SceneCommands, SizeBoundsTheSceneAndKeepsTheAspectRatio) {
  ASSERT_EQ(
      palpable({"make", in("left.png"), in("right.png"), "-o", in("s.palp"), "--size", "80x30x5"}).exit_code,
      0);
  const auto size = palpable({"info", in("s.palp"), "--json"}).json()["size_m"];
  EXPECT_NEAR(size[0], 0.04, 1e-9);
  EXPECT_NEAR(size[1], 0.03, 1e-9);
  EXPECT_LE(size[2].get<double>(), 0.005 + 1e-9);
}

TEST_F(SceneCommands, ProbeWritesTheForceOfEverySample) {
  write_text(in("path.csv"), "z_m,t_s,x_m,y_m\r\n0.05,0,0,0\r\n0.0,0.001,0,0\r\n-0.001,0.002,0.001,0\r\n");
  const Outcome outcome =
      palpable({"probe", in("a.palp"), "--path", in("path.csv"), "-o", in("f.csv"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto rows = rows_of(read_text(in("f.csv")));
  ASSERT_THAT(rows, SizeIs(4));
  EXPECT_THAT(rows[0], ElementsAre("t_s", "x_m", "y_m", "z_m", "fx_N", "fy_N", "fz_N", "contact", "proxy_x_m",
                                   "proxy_y_m", "proxy_z_m", "label"));
  EXPECT_EQ(rows[1][7], "0");
  EXPECT_EQ(rows[3][7], "1");
  EXPECT_GT(std::stod(rows[3][6]), 0.0);
  EXPECT_EQ(rows[1][0], "0");
  EXPECT_EQ(rows[2][0], "0.001");
  ASSERT_EQ(palpable({"probe", in("a.palp"), "--path", in("path.csv"), "-o", in("g.csv")}).exit_code, 0);
  EXPECT_EQ(read_text(in("f.csv")), read_text(in("g.csv")));
}

TEST_F(SceneCommands, LawsWithoutAProxyLeaveTheProxyFieldsEmpty) {
  write_text(in("path.csv"), "t_s,x_m,y_m,z_m\n0,0.01,0.01,9\n0.001,0.011,0.01,9\n");
  ASSERT_EQ(palpable({"probe", in("a.palp"), "--path", in("path.csv"), "-o", in("f.csv"), "--law", "rolling"})
                .exit_code,
            0);
  for (const auto& row : rows_of(read_text(in("f.csv")))) ASSERT_THAT(row, SizeIs(12));
  const auto rows = rows_of(read_text(in("f.csv")));
  EXPECT_EQ(rows[1][7], "1");
  EXPECT_EQ(rows[1][8], "");
  EXPECT_EQ(rows[1][6], "0");
}

TEST_F(SceneCommands, SamplePrintsTheModelsValues) {
  write_text(in("points.csv"), "x_m,y_m,z_m\n0,0,0.05\n0,0,-0.001\n0.5,0,0\n");
  const Outcome outcome =
      palpable({"sample", in("a.palp"), "--points", in("points.csv"), "-o", in("v.csv"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["in_domain"], 2);
  const auto rows = rows_of(read_text(in("v.csv")));
  EXPECT_THAT(rows[0], ElementsAre("x_m", "y_m", "z_m", "distance_m", "nx", "ny", "nz", "stiffness_N_per_m",
                                   "static_friction", "label"));
  EXPECT_GT(std::stod(rows[1][3]), 0.0);
  EXPECT_LT(std::stod(rows[2][3]), 0.0);
  EXPECT_NEAR(std::hypot(std::stod(rows[1][4]), std::stod(rows[1][5]), std::stod(rows[1][6])), 1.0, 1e-9);
  EXPECT_EQ(rows[3][3], "");
}

TEST_F(SceneCommands, AnInvalidPathIsNamedWithItsLine) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"t_s,x_m,y_m,z_m\n0,0,0,0\n0.001,nan,0,0\n", "line 3"},
      {"t_s,x_m,y_m,z_m\n0,0,0,0\n0.001,0,0\n", "line 3"},
      {"t_s,x_m,y_m\n0,0,0\n", "z_m"},
      {"", "missing"},
      {"t_s,x_m,y_m,z_m\n0.1,0,0,0\n0.05,0,0,0\n", ""}};
  for (const auto& [csv, sentence] : cases) {
    write_text(in("bad.csv"), csv);
    const Outcome outcome = palpable({"probe", in("a.palp"), "--path", in("bad.csv"), "-o", in("none.csv")});
    EXPECT_EQ(outcome.exit_code, 3) << csv;
    EXPECT_TRUE(is_one_sentence(outcome.err));
    EXPECT_THAT(outcome.err, HasSubstr("bad.csv"));
    EXPECT_THAT(outcome.err, HasSubstr(sentence));
    EXPECT_FALSE(std::filesystem::exists(in("none.csv")));
  }
}

TEST_F(SceneCommands, BenchTimesOnePathTickByTick) {
  std::string csv = "t_s,x_m,y_m,z_m\n";
  for (int i = 0; i < 2000; ++i)
    csv += std::to_string(0.001 * i) + "," + std::to_string(1e-5 * i - 0.01) + ",0,0\n";
  write_text(in("long.csv"), csv);
  const auto json = palpable({"bench", "--scene", in("a.palp"), "--path", in("long.csv"), "--law", "proxy",
                              "--radius", "1", "--friction", "0.4", "--json"})
                        .json();
  ASSERT_THAT(json["benchmarks"], SizeIs(1));
  const auto& b = json["benchmarks"][0];
  EXPECT_EQ(b["name"], "relief/proxy-friction/160x120");
  EXPECT_EQ(b["ticks"], 2000);
  EXPECT_GT(b["contact_fraction"], 0.9);
  EXPECT_LE(b["median_ns"], b["p99_ns"]);
  EXPECT_LE(b["p99_ns"], b["p99_9_ns"]);
  EXPECT_LE(b["p99_9_ns"], b["max_ns"]);
  EXPECT_GT(b["memory_bytes"], 0);
  const auto least =
      palpable({"bench", "--scene", in("a.palp"), "--path", in("long.csv"), "--passes", "3", "--json"})
          .json();
  EXPECT_EQ(least["benchmarks"][0]["ticks"], 2000);
}

TEST_F(SceneCommands, MakeComparesTheDetailOperatorsInOnePicture) {
  const Outcome outcome = palpable({"make", in("truth.pfm"), "--kind", "depth", "--depth-as", "disparity",
                                    "--detail", "compare", "-o", in("details.png"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(read_text(in("details.png")), StartsWith("\x89PNG"));
  const auto operators = outcome.json()["operators"];
  ASSERT_THAT(operators, SizeIs(9));
  EXPECT_EQ(operators[0]["detail"], "relief");
  for (const auto& o : operators) EXPECT_LE(o["greatest_slope"], 3.01) << o["detail"];
  EXPECT_EQ(
      palpable({"touch", in("truth.pfm"), "--detail", "compare", "--headless", "--seconds", "1"}).exit_code,
      2);
}

TEST_F(SceneCommands, ScoreComparesContoursWithDrawnOnes) {
  ASSERT_EQ(palpable({"make", in("left.png"), "--as", "contours", "-o", in("c.palp")}).exit_code, 0);
  ASSERT_EQ(palpable({"export", in("c.palp"), "-o", in("c.npz")}).exit_code, 0);
  const Outcome same = palpable({"score", "orientation", in("c.palp"), in("c.npz"), "--json"});
  ASSERT_EQ(same.exit_code, 0) << same.err;
  EXPECT_LT(same.json()["max_deg"], 0.1);
  ASSERT_EQ(palpable({"export", in("c.palp"), "-o", in("c.png")}).exit_code, 0);
  const Outcome lines =
      palpable({"score", "boundary", in("c.palp"), in("c.png"), "--truth", "lines", "--json"});
  ASSERT_EQ(lines.exit_code, 0) << lines.err;
  EXPECT_GT(lines.json()["best"]["f"], 0.95);
  EXPECT_EQ(palpable({"score", "boundary", in("a.palp"), in("c.png")}).exit_code, 3);
  EXPECT_EQ(palpable({"score", "orientation", in("c.palp"), in("none.npz")}).exit_code, 3);
}

TEST_F(SceneCommands, ShowDrawsEveryView) {
  for (const char* view : {"relief", "depth", "force", "section"}) {
    const std::string picture = in(std::string(view) + ".png");
    const Outcome outcome = palpable({"show", in("a.palp"), "-o", picture, "--view", view});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(read_text(picture), StartsWith("\x89PNG"));
  }
  EXPECT_EQ(palpable({"show", in("a.palp"), "-o", in("a.svg")}).exit_code, 0);
  EXPECT_EQ(palpable({"show", in("a.palp"), "-o", in("a.gif")}).exit_code, 2);
  EXPECT_EQ(palpable({"show", in("a.palp"), "-o", in("x.png"), "--view", "section", "--at", "900"}).exit_code,
            2);
}

TEST_F(SceneCommands, ExportWritesNpzAndPng) {
  ASSERT_EQ(palpable({"export", in("a.palp"), "-o", in("a.npz")}).exit_code, 0);
  const std::string npz = read_text(in("a.npz"));
  EXPECT_THAT(npz, StartsWith("PK"));
  EXPECT_THAT(npz, HasSubstr("height_m.npy"));
  EXPECT_THAT(npz, HasSubstr("pixel_m.npy"));
  const Outcome png = palpable({"export", in("a.palp"), "-o", in("h.png"), "--json"});
  EXPECT_EQ(png.exit_code, 0);
  EXPECT_GT(png.json()["metres_per_step"], 0.0);
  EXPECT_EQ(palpable({"export", in("a.palp"), "-o", in("a.xyz")}).exit_code, 2);
}

TEST_F(SceneCommands, ExportDrawsAReliefInDots) {
  ASSERT_EQ(palpable({"export", in("a.palp"), "-o", in("a.pbm")}).exit_code, 0);
  EXPECT_THAT(read_text(in("a.pbm")), AllOf(StartsWith("P1\n60 40\n"), HasSubstr("11")));
  ASSERT_EQ(palpable({"export", in("a.palp"), "-o", in("a.brf")}).exit_code, 0);
  EXPECT_THAT(read_text(in("a.brf")), HasSubstr("\f"));
}

TEST_F(SceneCommands, ExportFitsADrawingToPaper) {
  const auto exported = [&](const char* file, std::vector<std::string> options) {
    options.insert(options.begin(), {"export", in("a.palp"), "-o", in(file)});
    return palpable(options);
  };
  ASSERT_EQ(exported("a4.svg", {"--paper", "A4"}).exit_code, 0);
  // Wider than high: across.
  EXPECT_THAT(read_text(in("a4.svg")), HasSubstr("width=\"297.000mm\" height=\"210.000mm\""));
  ASSERT_EQ(exported("a3.svg", {"--paper", "A3"}).exit_code, 0);
  EXPECT_THAT(read_text(in("a3.svg")), HasSubstr("width=\"420.000mm\" height=\"297.000mm\""));
  ASSERT_EQ(exported("a4.brf", {"--paper", "A4"}).exit_code, 0);
  const std::string dots = read_text(in("a4.brf"));
  EXPECT_EQ(std::count(dots.begin(), dots.end(), '\n'), 19);
  const Outcome both = exported("both.svg", {"--paper", "A4", "--width", "100"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.err, HasSubstr("leave out --width"));
  EXPECT_THAT(exported("p.pbm", {"--paper", "A4"}).err, HasSubstr("--paper has no effect"));
}

TEST_F(SceneCommands, ExportWritesKeysOfNamesOntoADrawing) {
  ASSERT_EQ(
      palpable({"name", in("a.palp"), "--add", "Red door", "--at", "10,5", "-o", in("n.palp")}).exit_code, 0);
  const Outcome exported = palpable({"export", in("n.palp"), "-o", in("n.svg"), "--paper", "A4", "--json"});
  ASSERT_EQ(exported.exit_code, 0);
  EXPECT_EQ(exported.json()["files"].size(), 2);
  // The disc of its point, and dots of its key.
  EXPECT_THAT(read_text(in("n.svg")), AllOf(HasSubstr("r=\"2.000\""), HasSubstr("r=\"0.800\"")));
  EXPECT_THAT(read_text(in("n-key.svg")), HasSubstr("<title>Key of a tactile drawing</title>"));
  ASSERT_EQ(palpable({"export", in("n.palp"), "-o", in("n.brf"), "--paper", "A4"}).exit_code, 0);
  EXPECT_THAT(read_text(in("n.brf")), AllOf(HasSubstr("RD"), HasSubstr("DOOR")));
  // Without the name the sheet of its key goes.
  ASSERT_EQ(palpable({"export", in("a.palp"), "-o", in("n.svg")}).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(in("n-key.svg")));
}

TEST_F(SceneCommands, ExportSaysWhatASceneIsExportedAsAndWhatAnOptionIsFor) {
  const Outcome wrong = palpable({"export", in("a.palp"), "-o", in("a.vdb")});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err,
              HasSubstr("a relief is exported as .stl, .glb, .svg, .brf, .pbm, .npz, .png or .html"));
  const Outcome unread = palpable({"export", in("a.palp"), "-o", in("u.npz"), "--grid", "64"});
  EXPECT_EQ(unread.exit_code, 0);
  EXPECT_THAT(unread.err,
              HasSubstr("--grid has no effect on a relief as .npz: it is for a field as .vdb or .npz."));
  for (const std::vector<std::string>& option :
       {std::vector<std::string>{"--grid", "64"}, {"--lines", "raised"}, {"--braille-rows", "20"}}) {
    std::vector<std::string> command{"export", in("a.palp"), "-o", in("u.svg")};
    command.insert(command.end(), option.begin(), option.end());
    EXPECT_THAT(palpable(command).err, HasSubstr(option[0] + " has no effect"));
  }
  EXPECT_EQ(palpable({"export", in("a.palp"), "-o", in("u.svg"), "--interval", "1"}).err, "");
}

TEST_F(SceneCommands, MakeIsDeterministic) {
  ASSERT_EQ(palpable({"make", in("left.png"), in("right.png"), "-o", in("b.palp")}).exit_code, 0);
  EXPECT_EQ(read_text(in("a.palp")), read_text(in("b.palp")));
}

TEST_F(SceneCommands, AnExportedHeightMapIsReadAsADepthMap) {
  ASSERT_EQ(palpable({"export", in("a.palp"), "-o", in("h.png")}).exit_code, 0);
  EXPECT_EQ(palpable({"make", in("h.png"), "--kind", "depth", "-o", in("h.palp")}).exit_code, 0);
}

TEST_F(SceneCommands, APictureInsteadOfASceneIsNamedWithAdvice) {
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"show", in("left.png"), "-o", in("x.png")},
        {"info", in("left.png")},
        {"export", in("left.png"), "-o", in("x.npz")},
        {"probe", in("left.png"), "--path", in("p.csv"), "-o", in("f.csv")}}) {
    const Outcome outcome = palpable(command);
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_TRUE(is_one_sentence(outcome.err));
    EXPECT_THAT(outcome.err, HasSubstr("is a picture, and not a scene"));
    EXPECT_THAT(outcome.err, HasSubstr("palpable make " + in("left.png") + " -o left.palp"));
  }
}

TEST_F(SceneCommands, AnOutputsNameIsOnOneLineAndOneSampleIsCountedAsOne) {
  const Outcome outcome = palpable({"make", in("a.palp"), "-o", in("two\nlines.palp")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("two lines.palp: "));
  write_text(in("path.csv"), "t_s,x_m,y_m,z_m\n0,0,0,0.05\n");
  EXPECT_THAT(palpable({"probe", in("a.palp"), "--path", in("path.csv"), "-o", in("f.csv")}).out,
              HasSubstr("1 sample with "));
}

TEST_F(SceneCommands, MakeRefusesAnotherSuffixThanPalp) {
  const Outcome outcome = palpable({"make", in("left.png"), "-o", in("x.foo")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(is_one_sentence(outcome.err));
  EXPECT_THAT(outcome.err, HasSubstr("ends in .palp: write x.palp"));
  EXPECT_FALSE(std::filesystem::exists(in("x.foo")));
}

TEST_F(SceneCommands, TitleAndDescriptionAreStoredAndPrinted) {
  write_text(in("words.txt"), "A wall behind a box.\nThe floor is slanted.\n");
  const Outcome titled = palpable({"make", in("a.palp"), "-o", in("titled.palp"), "--title", "Wall and box",
                                   "--describe", "@" + in("words.txt")});
  ASSERT_EQ(titled.exit_code, 0) << titled.err;
  const auto json = palpable({"info", in("titled.palp"), "--json"}).json();
  EXPECT_EQ(json["title"], "Wall and box");
  EXPECT_EQ(json["description"], "A wall behind a box.\nThe floor is slanted.");
  EXPECT_THAT(palpable({"info", in("titled.palp")}).out, HasSubstr("title: Wall and box\n"));
  // They are kept when a scene is made from this scene without these options.
  ASSERT_EQ(palpable({"make", in("titled.palp"), "-o", in("again.palp")}).exit_code, 0);
  EXPECT_EQ(palpable({"info", in("again.palp"), "--json"}).json()["title"], "Wall and box");

  // As an editor on another system saves it.
  write_text(in("words.txt"),
             "\xEF\xBB\xBF"
             "A wall behind a box.\r\nThe floor is slanted.\r\n");
  ASSERT_EQ(
      palpable({"make", in("a.palp"), "-o", in("other.palp"), "--describe", "@" + in("words.txt")}).exit_code,
      0);
  EXPECT_EQ(palpable({"info", in("other.palp"), "--json"}).json()["description"], json["description"]);

  EXPECT_EQ(palpable({"make", in("a.palp"), "-o", in("no.palp"), "--title", "two\nlines"}).exit_code, 2);
  EXPECT_EQ(palpable({"make", in("a.palp"), "-o", in("no.palp"), "--title", "\xff"}).exit_code, 2);
  EXPECT_EQ(palpable({"make", in("a.palp"), "-o", in("no.palp"), "--describe", "@" + in("none")}).exit_code,
            3);
  EXPECT_FALSE(std::filesystem::exists(in("no.palp")));
}

}  // namespace
}  // namespace palpable::test
