// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/text/base64.hpp"

#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace palpable::sources {

/// What a server sends of a topic.
inline std::string ros_published(const std::string& topic, const std::string& message) {
  return fmt::format(R"({{"op":"publish","topic":"{}","msg":{}}})", topic, message);
}

template <class Value>
std::string ros_base64(const std::vector<Value>& values) {
  return base64(std::as_bytes(std::span(values)));
}

/// sensor_msgs/Image of ROS 1.
template <class Value>
std::string ros_picture(int width, int height, const std::string& encoding, std::size_t pixel_bytes,
                        const std::vector<Value>& values) {
  return fmt::format(
      R"({{"header":{{"seq":1,"stamp":{{"secs":1,"nsecs":2}},"frame_id":"c"}},"height":{},"width":{},)"
      R"("encoding":"{}","is_bigendian":0,"step":{},"data":"{}"}})",
      height, width, encoding, pixel_bytes * static_cast<std::size_t>(width), ros_base64(values));
}

}  // namespace palpable::sources
