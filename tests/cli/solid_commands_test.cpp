// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Valid and invalid solids: OpenVDB, meshes that are no solids, shapes found in a scene.
#include "palpable/formats/picture/picture.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

#include "program.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace palpable::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class SolidCommands : public InFolder {
 protected:
  Outcome make(const std::string& input, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"make",         path(input), "-o",   path("out.palp"),
                                       "--resolution", "32",        "--as", "field"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return palpable(arguments);
  }
  void expect_refused(const Outcome& outcome, const std::string& file, const std::string& reason) {
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_TRUE(is_one_sentence(outcome.err)) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(file));
    EXPECT_THAT(outcome.err, HasSubstr(reason));
    EXPECT_FALSE(std::filesystem::exists(path("out.palp")));
  }
  /// Distance at a place, metres; negative inside.
  double distance_m(const std::string& scene, const std::string& place) {
    write_text(path("q.csv"), "x_m,y_m,z_m\n" + place + "\n");
    EXPECT_EQ(palpable({"sample", path(scene), "--points", path("q.csv"), "-o", path("v.csv")}).exit_code, 0);
    std::string values = read_text(path("v.csv"));
    // The fourth number of the second line, after the place.
    values.erase(0, values.find('\n') + 1);
    for (int k = 0; k < 3; ++k) values.erase(0, values.find(',') + 1);
    return std::stod(values);
  }
};

/// A box of side 2 `half` around `x`, with triangles oriented outwards or inwards; the last `open` triangles
/// are omitted.
std::string box_obj(double x, double half, int first_vertex, bool outwards = true, int open = 0) {
  std::string obj;
  for (int k = 0; k < 8; ++k)
    obj += "v " + std::to_string(x + ((k & 1) != 0 ? half : -half)) + ' ' +
           std::to_string((k & 2) != 0 ? half : -half) + ' ' + std::to_string((k & 4) != 0 ? half : -half) +
           '\n';
  constexpr int kFaces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  for (int t = 0; t < 12 - open; ++t) {
    const auto corner = [&](int k) { return std::to_string(first_vertex + kFaces[t][k]); };
    obj += "f " + corner(0) + ' ' + corner(outwards ? 1 : 2) + ' ' + corner(outwards ? 2 : 1) + '\n';
  }
  return obj;
}

TEST_F(SolidCommands, AreCachedUnlessDisabled) {
  write_text(path("box.obj"), box_obj(0.0, 0.02, 1));
  const Outcome first = make("box.obj"), second = make("box.obj"), anew = make("box.obj", {"--no-cache"});
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(first.err, Not(HasSubstr("cache")));
  EXPECT_THAT(second.err, HasSubstr("came from the cache"));
  EXPECT_THAT(anew.err, Not(HasSubstr("cache")));
  EXPECT_TRUE(std::filesystem::is_directory(path("cache/palpable/scenes")));
}

TEST_F(SolidCommands, ASelfIntersectingMeshIsTheUnionOfItsBodies) {
  write_text(path("m.obj"), box_obj(0.0, 0.02, 1) + box_obj(0.02, 0.015, 9));
  const Outcome outcome = make("m.obj");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  // Deep in both bodies, at a wall of one of them.
  EXPECT_NEAR(distance_m("out.palp", "0.0195,0,0"), -0.0150, 0.001);
  EXPECT_NEAR(distance_m("out.palp", "-0.019,0,0"), -0.001, 0.0002);
  EXPECT_GT(distance_m("out.palp", "0,0,0.0205"), 0.0);
}

TEST_F(SolidCommands, DenseFieldsCanBeMadeTouchedAndDrawn) {
  write_text(path("m.obj"), box_obj(0.0, 0.02, 1));
  std::string steps = "t_s,x_m,y_m,z_m\n";
  for (int i = 0; i <= 200; ++i)
    steps += std::to_string(0.001 * i) + ",0.003,0," + std::to_string(0.0285 - 0.00005 * i) + "\n";
  write_text(path("path.csv"), steps);
  for (const std::string how : {"--dense", "--paper"}) {
    const Outcome made = make("m.obj", {how});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_NEAR(distance_m("out.palp", "0.003,0,0.0185"), -0.0015, 1e-5);
    const Outcome info = palpable({"info", path("out.palp"), "--json"});
    EXPECT_THAT(info.out, HasSubstr("\"kind\":\"dense-field\""));
    EXPECT_THAT(info.out, HasSubstr(how == "--paper" ? "\"distance and force\"" : "\"distance\""));
    for (const std::string law : {"penalty", "proxy"}) {
      const Outcome felt =
          palpable({"probe", path("out.palp"), "--path", path("path.csv"), "-o", path("f.csv"), "--law", law,
                    "--stiffness", "1000", "--damping", "0", "--json"});
      ASSERT_EQ(felt.exit_code, 0) << felt.err;
      EXPECT_NEAR(nlohmann::json::parse(felt.out).at("max_force_N").get<double>(), 1.5, 0.01) << how << law;
    }
    EXPECT_EQ(palpable({"show", path("out.palp"), "-o", path("cut.png")}).exit_code, 0);
    EXPECT_EQ(palpable({"export", path("out.palp"), "-o", path("out.stl")}).exit_code, 0);
    const Outcome level_set = palpable({"export", path("out.palp"), "-o", path("f.vdb"), "--grid", "33"});
    ASSERT_EQ(level_set.exit_code, 0) << level_set.err;
    ASSERT_EQ(palpable({"make", path("f.vdb"), "-o", path("back.palp"), "--resolution", "32"}).exit_code, 0);
    EXPECT_NEAR(distance_m("back.palp", "0.003,0,0.0185"), -0.0015, 1e-4);
    EXPECT_EQ(palpable({"touch", path("out.palp"), "--headless", "--seconds", "0.1"}).exit_code, 0);
    std::filesystem::remove(path("out.palp"));
  }
}

TEST_F(SolidCommands, TooLargeDenseFieldsAreRefusedWithTheirSizeAndTheLimit) {
  write_text(path("m.obj"), box_obj(0.0, 0.02, 1));
  const Outcome outcome =
      palpable({"make", path("m.obj"), "-o", path("out.palp"), "--paper", "--resolution", "2048"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(is_one_sentence(outcome.err)) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("m.obj"));
  EXPECT_THAT(outcome.err, HasSubstr("MiB as a dense field of 2048 cells"));
  EXPECT_THAT(outcome.err, HasSubstr("cells would fit"));
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"--dense", "--paper"}, {"--dense", "--max-error", "0.01"}})
    EXPECT_EQ(make("m.obj", wrong).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(path("out.palp")));
}

TEST_F(SolidCommands, DepthMapsFromSeveralPosesAreFused) {
  // A wall at 0.3 m with a box of 60 mm in front of it, seen from the left and from the right.
  const auto frame = [&](const std::string& name, double eye_m) {
    Raster<std::uint16_t> depth(160, 120);
    for (int y = 0; y < 120; ++y)
      for (int x = 0; x < 160; ++x) {
        const double right = (x - 79.5) / 200.0, down = (y - 59.5) / 200.0;
        const bool box = std::abs(eye_m + 0.24 * right) < 0.03 && std::abs(0.24 * down) < 0.03;
        depth(x, y) = static_cast<std::uint16_t>(box ? 2400 : 3000);
      }
    ASSERT_TRUE(formats::write_png(path(name), depth));
  };
  frame("f1.png", -0.02);
  frame("f2.png", 0.02);
  write_text(path("k.json"),
             R"({"fx": 200, "fy": 200, "cx": 79.5, "cy": 59.5, "width": 160, "height": 120})");
  write_text(path("poses.csv"), "frame,qw,qx,qy,qz,tx,ty,tz\n1,1,0,0,0,-0.02,0,0\n2,1,0,0,0,0.02,0,0\n");
  const auto fuse = [&](const std::string& poses) {
    return palpable({"make", path("f1.png"), path("f2.png"), "-o", path("out.palp"), "--kind", "depth",
                     "--poses", path(poses), "--calibration", path("k.json"), "--depth-scale", "0.0001",
                     "--resolution", "64"});
  };
  const Outcome outcome = fuse("poses.csv");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("2 depth maps were fused"));
  // The cameras look along z of their world: it is turned so that they look away from the person.
  EXPECT_THAT(outcome.err, HasSubstr("turned by right angles"));
  EXPECT_LT(distance_m("out.palp", "0,0,-0.25"), -0.004);
  EXPECT_GT(distance_m("out.palp", "0,0,-0.23"), 0.004);
  EXPECT_GT(distance_m("out.palp", "0.05,0,-0.27"), 0.004);
  std::filesystem::remove(path("out.palp"));
  write_text(path("poses.csv"), "frame,qw,qx,qy,qz,tx,ty,tz\n1,1,0,0,0,0,0,0\n");
  expect_refused(fuse("poses.csv"), "f2.png", "has no pose");
  write_text(path("poses.csv"), "frame,qw,qx,qy,qz,tx,ty,tz\n1,2,0,0,0,0,0,0\n");
  expect_refused(fuse("poses.csv"), "poses.csv", "not a unit quaternion");
}

TEST_F(SolidCommands, TheEgocentricViewRotatesWithItsExplorer) {
  write_text(path("m.obj"), box_obj(0.0, 0.02, 1));
  ASSERT_EQ(make("m.obj").exit_code, 0);
  // The explorer is right of the box and faces it: ahead means left, and the wall pushes back.
  write_text(path("walk.csv"), "t_s,x_m,y_m,heading_deg\n0,0.1,0,0\n0.01,0.05,0,90\n");
  std::string steps = "t_s,x_m,y_m,z_m\n";
  for (int i = 0; i <= 100; ++i)
    steps += std::to_string(0.011 + 0.001 * i) + ",0," + std::to_string(0.022 + 0.0001 * i) + ",0\n";
  write_text(path("path.csv"), steps);
  const auto probe = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "probe",   path("out.palp"), "--path", path("path.csv"), "-o",  path("f.csv"), "--law",
        "penalty", "--damping",      "0",      "--stiffness",    "1000"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return palpable(arguments).exit_code;
  };
  ASSERT_EQ(probe({"--view", "egocentric", "--walk", path("walk.csv")}), 0);
  const std::string forces = read_text(path("f.csv"));
  std::istringstream last(forces.substr(forces.rfind('\n', forces.size() - 2) + 1));
  std::vector<double> numbers;
  for (std::string field; std::getline(last, field, ',') && numbers.size() < 7;)
    numbers.push_back(std::stod(field));
  EXPECT_NEAR(numbers[2], 0.032, 1e-12);
  EXPECT_NEAR(numbers[4], 0.0, 0.01);
  EXPECT_NEAR(numbers[5], -2.0, 0.05);
  EXPECT_NEAR(numbers[6], 0.0, 0.01);
  EXPECT_EQ(probe({"--walk", path("walk.csv")}), 2);
  // The pose is used live, recorded, and printed.
  const Outcome touched = palpable({"touch", path("out.palp"), "--headless", "--seconds", "0.2", "--view",
                                    "egocentric", "--walk", path("walk.csv"), "--record", path("t.rec")});
  EXPECT_EQ(touched.exit_code, 0) << touched.err;
  EXPECT_THAT(touched.err, HasSubstr("facing left"));
  EXPECT_THAT(read_text(path("t.rec")), HasSubstr("\"translation_m\":[0.05,0.0,"));
  EXPECT_EQ(
      palpable({"touch", path("out.palp"), "--view", "egocentric", "--walk", path("walk.csv")}).exit_code, 2);
  write_text(path("walk.csv"), "t_s,x_m,y_m,heading_deg\n1,0,0,0\n1,0,0,0\n");
  EXPECT_EQ(probe({"--view", "egocentric", "--walk", path("walk.csv")}), 3);
}

TEST_F(SolidCommands, FingerPadsFeelForceAndTorque) {
  write_text(path("m.obj"), box_obj(0.0, 0.02, 1));
  ASSERT_EQ(make("m.obj").exit_code, 0);
  // Finger 0 is upright on the top, finger 1 is tilted on its edge, finger 2 is in the air.
  std::string steps = "t_s,x_m,y_m,z_m,probe,qw,qx,qy,qz\n";
  for (int i = 0; i <= 20; ++i) {
    const std::string t = std::to_string(0.001 * i) + ',',
                      z = ",0," + std::to_string(0.0285 - 0.0001 * i) + ',';
    steps += t + "0.000" + z + "0,1,0,0,0\n" + t + "0.018" + z + "1,0.98,0,0.199,0\n" + t + "0.2" + z +
             "2,1,0,0,0\n";
  }
  write_text(path("hand.csv"), steps);
  const auto probe = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"probe", path("out.palp"), "--path", path("hand.csv"),
                                       "-o",    path("f.csv"),    "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return palpable(arguments);
  };
  const Outcome outcome = probe({"--tool", "pad", "--law", "penalty", "--damping", "0"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto told = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(told.at("probes"), 3);
  EXPECT_EQ(told.at("places"), 32);
  EXPECT_GT(told.at("max_torque_Nm").get<double>(), 1e-5);
  std::istringstream lines(read_text(path("f.csv")));
  std::string line, last[3];
  std::getline(lines, line);
  EXPECT_EQ(
      line,
      "t_s,x_m,y_m,z_m,fx_N,fy_N,fz_N,contact,proxy_x_m,proxy_y_m,proxy_z_m,label,probe,tx_Nm,ty_Nm,tz_Nm");
  for (int i = 0; std::getline(lines, line); ++i) last[i % 3] = line;
  EXPECT_THAT(last[0], HasSubstr(",1,,,,0,0,"));
  EXPECT_THAT(last[2], HasSubstr("0,0,0,0,,,,0,2,0,0,0"));
  // Places of a pad from a file give the same result; invalid ones are refused.
  write_text(path("tool.csv"), "x_m,y_m,z_m,share\n0,0,-0.008,1\n");
  EXPECT_EQ(probe({"--tool", path("tool.csv")}).exit_code, 0);
  EXPECT_EQ(probe({"--tool", "glove"}).exit_code, 2);
  write_text(path("tool.csv"), "x_m,y_m,z_m,share\n0,0,-0.008,0\n");
  EXPECT_EQ(probe({"--tool", path("tool.csv")}).exit_code, 3);
  write_text(path("hand.csv"), "t_s,x_m,y_m,z_m,probe\n0,0,0,0,1.5\n");
  const Outcome refused = probe({});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_TRUE(is_one_sentence(refused.err)) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("hand.csv"));
}

TEST_F(SolidCommands, AnInsideOutMeshIsReoriented) {
  write_text(path("m.obj"), box_obj(0.0, 0.02, 1, false));
  const Outcome outcome = make("m.obj");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("turned to face outwards"));
  EXPECT_NEAR(distance_m("out.palp", "0,0,0.019"), -0.001, 0.0002);
}

TEST_F(SolidCommands, AnOpenMeshIsClosedWithAMessage) {
  write_text(path("m.obj"), box_obj(0.0, 0.02, 1, true, 2));
  const Outcome outcome = make("m.obj");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("closed"));
  EXPECT_NEAR(distance_m("out.palp", "0.019,0,0"), -0.001, 0.0002);
}

TEST_F(SolidCommands, TrianglesWithNanVerticesAreOmitted) {
  write_text(path("m.obj"), box_obj(0.0, 0.02, 1) + "v nan nan nan\nf 9 1 2\n");
  const Outcome outcome = make("m.obj");
  if (outcome.exit_code == 3) {
    EXPECT_TRUE(is_one_sentence(outcome.err)) << outcome.err;
    return;
  }
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NEAR(distance_m("out.palp", "0,0,0.019"), -0.001, 0.0002);
}

TEST_F(SolidCommands, AMeshWithAFalseTriangleCountIsRefused) {
  std::string stl(84, '\0');
  const unsigned count = 10'000'000;
  for (unsigned k = 0; k < 4; ++k) stl[80 + k] = static_cast<char>(count >> (8 * k));
  write_text(path("huge.stl"), stl);
  expect_refused(make("huge.stl", {"--kind", "mesh"}), "huge.stl", "");
}

TEST_F(SolidCommands, ExponentsAreAcceptedUpToTheirLimits) {
  const auto shape = [&](const std::string& e1, const std::string& e2) {
    write_text(path("s.json"), R"({"primitives": [{"size_m": [0.02, 0.02, 0.02], "exponents": [)" + e1 +
                                   ", " + e2 + R"(], "position_m": [0, 0, 0]}]})");
    return palpable(
        {"make", path("s.json"), "-o", path("out.palp"), "--resolution", "16", "--max-error", "1"});
  };
  for (const auto& [e1, e2] : {std::pair("0.1", "0.1"), std::pair("1.9", "1.9")}) {
    const Outcome outcome = shape(e1, e2);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NEAR(distance_m("out.palp", "0,0,0.021"), 0.001, 0.0005) << e1 << ' ' << e2;
  }
  std::filesystem::remove(path("out.palp"));
  for (const char* bad : {"0.04", "2.5", "-1"}) expect_refused(shape(bad, "1"), "s.json", "exponent");
}

TEST_F(SolidCommands, AFieldSurvivesAnOpenVdbRoundTrip) {
  write_text(
      path("s.json"),
      R"({"primitives": [{"size_m": [0.03, 0.02, 0.02], "exponents": [1, 1], "position_m": [0, 0, 0]}]})");
  ASSERT_EQ(make("s.json", {"--max-error", "0.05"}).exit_code, 0);
  const Outcome info = palpable({"info", path("out.palp"), "--json"});
  ASSERT_EQ(info.json()["primitives"].size(), 1U) << info.out;
  EXPECT_NEAR(info.json()["primitives"][0]["size_m"][0].get<double>(), 0.03, 1e-12);
  for (const char* band : {"narrow", "full"}) {
    const Outcome out =
        palpable({"export", path("out.palp"), "-o", path("f.vdb"), "--grid", "64", "--band", band});
    ASSERT_EQ(out.exit_code, 0) << out.err;
    ASSERT_EQ(palpable({"make", path("f.vdb"), "-o", path("back.palp"), "--resolution", "32", "--max-error",
                        "0.05"})
                  .exit_code,
              0);
    for (const char* place : {"0.031,0,0", "0,0,0.0195", "0,0.021,0"})
      EXPECT_NEAR(distance_m("back.palp", place), distance_m("out.palp", place), 0.0003)
          << band << ' ' << place;
  }
  const std::string vdb = read_text(path("f.vdb"));
  std::filesystem::remove(path("out.palp"));
  write_text(path("cut.vdb"), vdb.substr(0, vdb.size() / 2));
  expect_refused(make("cut.vdb"), "cut.vdb", "cut-off");
}

TEST_F(SolidCommands, ShapesAreFittedToADepthMap) {
  // A ball of 30 mm in front of a wall 300 mm away, with a focal length of 200 pixels.
  constexpr int kWidth = 160, kHeight = 120;
  Raster<std::uint16_t> depth(kWidth, kHeight, 3000);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double u = (x - 79.5) / 200.0, v = (y - 59.5) / 200.0;
      // |t (u, v, 1) - (0, 0, 0.25)| = 0.03.
      const double a = u * u + v * v + 1.0, b = -0.25, c = 0.0625 - 0.0009, root = b * b - a * c;
      if (root > 0.0) depth(x, y) = static_cast<std::uint16_t>(1e4 * (-b - std::sqrt(root)) / a);
    }
  ASSERT_TRUE(formats::write_png(path("d.png"), depth));
  write_text(path("d.json"), R"({"metres_per_unit": 0.0001, "fx": 200, "fy": 200, "cx": 79.5, "cy": 59.5, )"
                             R"("width": 160, "height": 120})");
  const Outcome fitted =
      palpable({"fit-shapes", path("d.png"), "-o", path("s.json"), "--kind", "depth", "--json"});
  ASSERT_EQ(fitted.exit_code, 0) << fitted.err;
  const auto primitives = fitted.json()["primitives"];
  ASSERT_EQ(primitives.size(), 2U) << fitted.out;
  EXPECT_NEAR(primitives[1]["position_m"][2].get<double>(), -0.25, 0.006);
  EXPECT_NEAR(primitives[1]["size_m"][0].get<double>(), 0.03, 0.005);
  EXPECT_EQ(make("s.json", {"--max-error", "1"}).exit_code, 0);
  const Outcome published = palpable({"fit-shapes", path("d.png"), "-o", path("p.json"), "--kind", "depth",
                                      "--fit", "solina", "--deformation", "none", "--json"});
  ASSERT_EQ(published.exit_code, 0) << published.err;
  EXPECT_NE(published.json()["primitives"], primitives);
  EXPECT_NE(palpable({"methods", "shapes"}).out.find("solina"), std::string::npos);
  const Outcome refused = palpable({"fit-shapes", path("s.json"), "-o", path("t.json")});
  EXPECT_EQ(refused.exit_code, 2) << refused.err;
  EXPECT_TRUE(is_one_sentence(refused.err));
}

TEST_F(SolidCommands, FitsShapesToAMesh) {
  std::string box;
  for (const char* corner : {"-0.03 -0.02 -0.01", "0.03 -0.02 -0.01", "0.03 0.02 -0.01", "-0.03 0.02 -0.01",
                             "-0.03 -0.02 0.01", "0.03 -0.02 0.01", "0.03 0.02 0.01", "-0.03 0.02 0.01"})
    box += "v " + std::string(corner) + "\n";
  box += "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  write_text(path("box.obj"), box);
  const Outcome fitted =
      palpable({"fit-shapes", path("box.obj"), "-o", path("s.json"), "--json", "--size", "9x9x9"});
  ASSERT_EQ(fitted.exit_code, 0) << fitted.err;
  EXPECT_THAT(fitted.err, HasSubstr("--size has no effect on fitted shapes"));
  const auto primitives = fitted.json()["primitives"];
  ASSERT_EQ(primitives.size(), 1U) << fitted.out;
  auto half_m = primitives[0]["size_m"].get<std::vector<double>>();
  std::sort(half_m.begin(), half_m.end());
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(half_m[k], 0.01 * static_cast<double>(k + 1), 0.0005);
  write_text(path("l.png"), "");
  const Outcome labelled =
      palpable({"fit-shapes", path("box.obj"), "-o", path("t.json"), "--labels", path("l.png")});
  EXPECT_EQ(labelled.exit_code, 2);
  EXPECT_TRUE(is_one_sentence(labelled.err));
}

}  // namespace
}  // namespace palpable::test
