// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/session/touch/live_address.hpp"
#include "palpable/session/touch/live_source.hpp"
#include "palpable/session/touch/matched_source.hpp"
#include "palpable/sources/live/rosbridge_client.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace palpable::session {

/// Places of a camera's topics in a client's list: of a depth camera depth, colours and its camera; of a
/// stereo camera the left and the right picture and their cameras.
struct RosEyesTopics {
  std::size_t depth = 0, colour = 0, info = 0;
  std::size_t left = 0, right = 0, left_info = 0, right_info = 0;
};

/// Adds the topics of an address's camera to a client's list.
RosEyesTopics add_topics(const RosAddress& address, std::vector<std::string>& topics);

/// The frames of the depth camera (RosAddress::pair is not given) of a rosbridge server.
std::unique_ptr<LiveSource> ros_depths(std::shared_ptr<sources::RosbridgeClient> client,
                                       const RosEyesTopics& topics, const RosAddress& address);

/// Whether a pair waits for its server to state the cameras (CameraInfo), or they are known otherwise.
enum class RosCameras : std::uint8_t { stated, known };

/// The pairs of the stereo camera (RosAddress::pair) of a rosbridge server, each with its rig: two pictures
/// whose times are at most 10 ms apart, or, of a server that states none, that arrived within 100 ms. Its
/// take() also has the error that the cameras have no baseline.
std::unique_ptr<PairSource> ros_pairs(std::shared_ptr<sources::RosbridgeClient> client,
                                      const RosEyesTopics& topics, const RosAddress& address,
                                      RosCameras cameras);

/// The depth of either, by `fast` for a stereo camera.
std::unique_ptr<LiveSource> ros_eyes(std::shared_ptr<sources::RosbridgeClient> client,
                                     const RosEyesTopics& topics, const RosAddress& address,
                                     const Work& work);

}  // namespace palpable::session
