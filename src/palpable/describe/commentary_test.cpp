// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/commentary.hpp"

#include "palpable/describe/test_scenes.hpp"

#include <vector>

namespace palpable::describe {
namespace {

using Sentences = std::vector<std::string>;

/// A probe that moves between two places in `seconds`, sampled at 60 Hz.
class Sweep {
 public:
  explicit Sweep(models::Scene scene) : scene_(std::move(scene)) {}

  void go(Place from, Place to, double seconds) {
    constexpr double kFrame_s = 1.0 / 60.0;
    const int frames = static_cast<int>(seconds / kFrame_s);
    for (int k = 0; k <= frames; ++k, now_s_ += kFrame_s) {
      const double t = static_cast<double>(k) / frames;
      const Place place{from.x_m + t * (to.x_m - from.x_m), from.y_m + t * (to.y_m - from.y_m)};
      if (auto words = commentary_.at(scene_, 1.0, place, now_s_)) said_.push_back(*words);
    }
  }
  void hear(Place place) { commentary_.heard(scene_, place, now_s_); }
  Sentences said() const { return said_; }

 private:
  models::Scene scene_;
  Commentary commentary_;
  Sentences said_;
  double now_s_ = 100.0;
};

TEST(Commentary, SaysANameOnceOnEntering) {
  Sweep sweep(named_hills());
  sweep.go({-0.03, 0.02}, {-0.028, 0.02}, 3.0);
  EXPECT_EQ(sweep.said(), Sentences{"Tall hill"});
}

TEST(Commentary, SaysWhatASlowSweepMeets) {
  Sweep sweep(named_hills());
  sweep.go({-0.03, 0.02}, {0.025, -0.015}, 8.0);
  EXPECT_EQ(sweep.said(), (Sentences{"Tall hill", "Table", "Low hill"}));
}

TEST(Commentary, StaysSilentOnWhatAQuickSweepOnlyCrosses) {
  Sweep sweep(named_hills());
  // 24 mm of hill in 0.06 s.
  sweep.go({-0.05, 0.02}, {0.05, 0.02}, 0.25);
  for (const std::string& words : sweep.said()) EXPECT_NE(words, "Tall hill");
}

TEST(Commentary, IsCalmOnABorder) {
  Sweep sweep(named_hills());
  // A hand that oscillates across the border of a hill, 1 mm to each side, at 10 Hz.
  for (int k = 0; k < 50; ++k) {
    sweep.go({-0.0415, 0.02}, {-0.0425, 0.02}, 0.05);
    sweep.go({-0.0425, 0.02}, {-0.0415, 0.02}, 0.05);
  }
  EXPECT_LE(sweep.said().size(), 2U);
}

TEST(Commentary, SaysAnEdgeOnceWhereNothingHasAName) {
  Sweep sweep(surface_scene([](double x, double) { return x > 0.0 ? 0.01 : 0.001; }));
  sweep.go({-0.02, 0.0}, {0.02, 0.0}, 2.0);
  EXPECT_EQ(sweep.said(), Sentences{"Edge up"});
  sweep.go({0.02, 0.0}, {-0.02, 0.0}, 2.0);
  EXPECT_EQ(sweep.said(), (Sentences{"Edge up", "Edge down"}));
}

TEST(Commentary, SaysAnEdgeThatAFastProbeJumpsOver) {
  Sweep sweep(surface_scene([](double x, double) { return x > 0.0 ? 0.01 : 0.001; }));
  sweep.go({-0.04, 0.0}, {0.04, 0.0}, 0.1);
  EXPECT_EQ(sweep.said(), Sentences{"Edge up"});
}

TEST(Commentary, SpeaksAtMostOnceInItsGap) {
  Sweep sweep(
      surface_scene([](double x, double) { return std::fmod(x + 1.0, 0.01) > 0.005 ? 0.01 : 0.001; }));
  constexpr double kSeconds = 6.0;
  sweep.go({-0.049, 0.0}, {0.049, 0.0}, kSeconds);
  EXPECT_GE(sweep.said().size(), 3U);
  EXPECT_LE(static_cast<double>(sweep.said().size()), kSeconds / CommentaryOptions{}.gap_s + 1.0);
}

TEST(Commentary, SaysTheLinesOfContours) {
  Sweep sweep(circle_and_line());
  sweep.go({0.0, -0.03}, {0.0, -0.0202}, 1.0);
  sweep.go({0.0, -0.0202}, {0.02, -0.0202}, 2.0);
  EXPECT_EQ(sweep.said(), Sentences{"On the line"});
}

TEST(Commentary, DoesNotRepeatWhatTheUserHasHeard) {
  Sweep sweep(named_hills());
  sweep.hear({-0.03, 0.02});
  sweep.go({-0.03, 0.02}, {-0.028, 0.02}, 3.0);
  EXPECT_EQ(sweep.said(), Sentences{});
}

}  // namespace
}  // namespace palpable::describe
