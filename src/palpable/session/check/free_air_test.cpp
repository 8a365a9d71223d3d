// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/check/recorded_forces.hpp"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

/// A surface in a slab around x = 0, as the top of a crest that a straight way cuts in a few micrometres.
class Slab : public haptics::Touchable {
 public:
  explicit Slab(double half_m) : half_m_(half_m) {}
  haptics::LawOutput evaluate(const haptics::Hand& hand, haptics::TouchState&) const noexcept override {
    haptics::LawOutput output;
    output.contact = std::abs(hand.position.v.x) < half_m_;
    return output;
  }
  std::uint64_t state_family() const noexcept override { return 0; }
  double damping_Ns_per_m() const noexcept override { return 0.0; }
  void touch_pages() const noexcept override {}

 private:
  double half_m_;
};

bool is_free(double half_m, double from_m, double to_m, double proxy_m) {
  haptics::HapticScene scene;
  scene.touchable = std::make_shared<const Slab>(half_m);
  device::TouchSample before, tick;
  before.position.v.x = from_m;
  tick.position.v.x = to_m;
  tick.proxy.v.x = proxy_m;
  tick.dt_s = 0.001;
  tick.flags |= haptics::flag::kHasProxy;
  return is_in_free_air(scene, before, tick);
}

TEST(FreeAir, ACrestThatTheLineToTheProxyCutsInAFewMicrometresIsASurface) {
  // Places 0.1 mm apart step over it.
  EXPECT_FALSE(is_free(1e-5, -0.00026, -0.00025, 0.00025));
  EXPECT_FALSE(is_free(1e-5, 0.00025, -0.00025, -0.00025));
  EXPECT_TRUE(is_free(1e-5, -0.00026, -0.00025, -0.00002));
}

}  // namespace
}  // namespace palpable::session
