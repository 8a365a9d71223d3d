// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/touch/live_address.hpp"
#include "palpable/session/touch/live_source.hpp"

#include <memory>

namespace palpable::session {

/// A robot of a rosbridge server: the live source of what its camera sees, and its control
/// (LiveSource::robot()). Nothing is sent to it before RobotControl::request_start(). `work`: threads for the
/// pairs of a stereo camera. Errors: as RosbridgeClient::open(), and check() of the address's DriveOptions.
Result<std::unique_ptr<LiveSource>> open_robot_source(const RobotAddress& address, const Work& work);

}  // namespace palpable::session
