// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/models/relief/relief.hpp"

#include <memory>
#include <span>

namespace palpable::session {

/// The next surface of a live source for these hands (in the air, on the surface or in it; balls of
/// `radius_m` >= 0), `passed_s` > 0 after `shown`: at a hand that `coming` would cover it rises from `shown`
/// to the ball at once and then by 30 mm/s, and by a slope of 1 more with the distance from 4 mm on, so that
/// what comes up lifts a hand slowly, and what is gone in the next picture has hardly lifted it. It falls at
/// once. `coming` itself where nothing rises that fast, or where both differ in their pixels. Heights and
/// places in metres of the scene; passed_s counts up to 0.1.
std::shared_ptr<const models::Relief> risen_surface(const models::Relief& shown,
                                                    std::shared_ptr<const models::Relief> coming,
                                                    std::span<const Point<SceneFrame>> hands, double radius_m,
                                                    double passed_s);

}  // namespace palpable::session
