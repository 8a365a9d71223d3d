// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/falcon/falcon.hpp"
#include "palpable/device/virtual/virtual_falcon.hpp"

#include <memory>

#include <gtest/gtest.h>

namespace palpable::device {

/// A driver in simulated time on a virtual Falcon that is homed.
class FalconBench : public testing::Test {
 protected:
  static FalconOptions stepped(const std::string& firmware = {}) {
    FalconOptions options;
    options.firmware = firmware;
    options.own_thread = false;
    return options;
  }
  void open() {
    auto opened = Falcon::open(falcon_->plug_in(), stepped());
    ASSERT_TRUE(opened) << opened.error().sentence();
    device_ = *std::move(opened);
  }
  Reading ticks(int count, Vec3 force_N = {}) {
    Reading reading;
    for (int k = 0; k < count; ++k) {
      reading = device_->read();
      device_->write({force_N});
    }
    return reading;
  }

  std::unique_ptr<VirtualFalcon> falcon_ = std::make_unique<VirtualFalcon>();
  std::unique_ptr<Falcon> device_;
};

}  // namespace palpable::device
