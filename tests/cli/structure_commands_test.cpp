// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Points and camera paths compared with the truth.
#include <cmath>
#include <string>

#include "program.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace palpable::test {
namespace {

using ::testing::HasSubstr;

class StructureCommands : public InFolder {};

std::string points_ply(double height) {
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 400\nproperty float x\nproperty float y\nproperty float z\n"
      "end_header\n";
  for (int i = 0; i < 400; ++i)
    ply += std::to_string(i % 20 / 19.0) + ' ' + std::to_string(i / 20 / 19.0) + ' ' +
           std::to_string(height) + '\n';
  return ply;
}

// Six cameras on an arc, in a world `scale` times as large.
std::string poses_csv(double scale) {
  std::string csv = "frame,qw,qx,qy,qz,tx,ty,tz\n";
  for (int i = 0; i < 6; ++i)
    csv += std::to_string(i) + ",1,0,0,0," + std::to_string(scale * 0.1 * i) + ',' +
           std::to_string(scale * 0.01 * i * i) + ',' + std::to_string(scale * 2.0) + '\n';
  return csv;
}

TEST_F(StructureCommands, ScoresStructureByTheCamerasOfBothWorlds) {
  // The result is half as large, and 2 % of the square's diagonal above it in the truth's unit.
  write_text(path("truth.obj"), "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  std::string halved =
      "ply\nformat ascii 1.0\nelement vertex 400\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n";
  for (int i = 0; i < 400; ++i)
    halved += std::to_string(i % 20 / 38.0) + ' ' + std::to_string(i / 20 / 38.0) + " 0.01\n";
  write_text(path("points.ply"), halved);
  write_text(path("found.csv"), poses_csv(0.5));
  write_text(path("true.csv"), poses_csv(1.0));
  const Outcome aligned = palpable({"score", "structure", path("points.ply"), path("truth.obj"), "--poses",
                                    path("found.csv"), "--true-poses", path("true.csv"), "--json"});
  ASSERT_EQ(aligned.exit_code, 0) << aligned.err;
  const auto json = aligned.json();
  EXPECT_NEAR(json["path"]["position_rms_percent"].get<double>(), 0, 1e-3);
  EXPECT_NEAR(json["accuracy_median_percent"].get<double>(), 100 * 0.02 / json["diagonal"].get<double>(),
              1e-3);
  EXPECT_NEAR(json["diagonal"].get<double>(), std::sqrt(2.0), 0.1);
}

TEST_F(StructureCommands, ScoresStructureInItsOwnCoordinatesWithoutPosesAndSaysSo) {
  write_text(path("points.ply"), points_ply(0.01));
  write_text(path("scan.ply"), points_ply(0.0));
  const Outcome plain = palpable({"score", "structure", path("points.ply"), path("scan.ply"), "--json"});
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_THAT(plain.err, HasSubstr("nothing is aligned"));
  EXPECT_TRUE(plain.json()["path"].is_null());
  const Outcome half =
      palpable({"score", "structure", path("points.ply"), path("scan.ply"), "--poses", path("no.csv")});
  EXPECT_EQ(half.exit_code, 2) << half.err;
  EXPECT_TRUE(is_one_sentence(half.err)) << half.err;
}

}  // namespace
}  // namespace palpable::test
