// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/device/url.hpp"
#include "palpable/session/touch/live_address.hpp"

#include <initializer_list>
#include <string>
#include <utility>

namespace palpable::session {

/// Takes the topics that options of an address name. Errors: usage for what is no name of a topic.
Result<void> take_topics(device::DeviceUrl& url,
                         std::initializer_list<std::pair<const char*, std::string*>> topics);

/// Takes the options of a robot's address, beside those of its depth camera; leaves others. Errors: usage.
Result<RobotAddress> take_robot_options(device::DeviceUrl& url, RosAddress pictures);

}  // namespace palpable::session
