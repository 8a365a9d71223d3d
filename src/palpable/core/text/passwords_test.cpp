// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/passwords.hpp"

#include <gtest/gtest.h>

namespace palpable {
namespace {

TEST(WithoutPasswords, LeavesNamesAndPasswordsOfAddressesOut) {
  EXPECT_EQ(without_passwords("rtsp://me:secret@cam/s: is lost"), "rtsp://cam/s: is lost");
  EXPECT_EQ(without_passwords("RTSP://me:sec#r@et@cam"), "RTSP://cam");
  EXPECT_EQ(without_passwords("https://a:b@c/#right=https://d:e@f/"), "https://c/#right=https://f/");
  EXPECT_EQ(without_passwords("http://host/a b@c"), "http://host/a b@c");
  for (const char* same : {"", "a@b", "scene.palp: is damaged", "://", "http://host/path", "robot:host:9090"})
    EXPECT_EQ(without_passwords(same), same);
}

}  // namespace
}  // namespace palpable
