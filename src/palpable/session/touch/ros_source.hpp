// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/touch/live_address.hpp"
#include "palpable/session/touch/live_source.hpp"

#include <memory>

namespace palpable::session {

/// The depth camera of a rosbridge server (sources::RosbridgeClient). Errors: as RosbridgeClient::open().
Result<std::unique_ptr<LiveSource>> open_ros_source(const RosAddress& address);

}  // namespace palpable::session
