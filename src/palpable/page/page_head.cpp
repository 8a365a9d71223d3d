// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/page_head.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace palpable::page {
namespace {

// In the order of their enumeration.
constexpr std::array kPictures{"come", "missing", "ended"};
constexpr double kFarthest_m = 10.0, kOldest_s = 1000.0;
constexpr int kMostHeads = 100;

}  // namespace

protocol::Head page_head(const session::HeadNews& news, std::chrono::steady_clock::time_point now) {
  protocol::Head head;
  head.pictures = kPictures.at(static_cast<std::size_t>(news.pictures));
  head.age_s = std::clamp(std::chrono::duration<double>(now - news.taken).count(), 0.0, kOldest_s);
  if (!news.head) return head;
  const Vec3& eyes = news.head->eyes_m;
  const auto is_near = [](double at) { return std::abs(at) <= kFarthest_m; };
  if (!is_near(eyes.x) || !is_near(eyes.y) || !is_near(eyes.z)) return head;
  head.place = protocol::HeadPlace{eyes.x, eyes.y, eyes.z};
  head.heads = std::min(news.head->heads, kMostHeads);
  return head;
}

}  // namespace palpable::page
