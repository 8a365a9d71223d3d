// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <random>

// For tests.
namespace palpable::session {

struct LinkQuality {
  /// One way, s.
  double delay_s = 0.0;
  /// Added to it, evenly distributed from 0 to this, s.
  double jitter_s = 0.0;
  /// The part of the messages that is lost. A lost message comes after two more delays and 10 ms, when it has
  /// been sent again, and all later ones wait for it, as TCP does.
  double loss = 0.0;
  /// Otherwise each message comes at its own time, a lost one never, and messages overtake each other.
  bool is_in_order = true;
  /// The part of the messages that comes a second time, after another delay.
  double twice = 0.0;
};

/// One direction of a connection in simulated time.
template <class T>
class VirtualLink {
 public:
  VirtualLink(const LinkQuality& quality, std::uint32_t seed) : quality_(quality), random_(seed) {}

  void put(double now_s, const T& message) {
    std::uniform_real_distribution<double> part(0.0, 1.0);
    constexpr double kSentAgain_s = 0.01;
    const bool is_lost = part(random_) < quality_.loss;
    const double again_s = is_lost ? 2.0 * quality_.delay_s + kSentAgain_s : 0.0;
    double arrives_s = now_s + quality_.delay_s + quality_.jitter_s * part(random_);
    if (quality_.is_in_order) arrives_s = last_s_ = std::max(last_s_, arrives_s + again_s);
    if (is_cut_ || (is_lost && !quality_.is_in_order)) return;
    add(arrives_s, message);
    if (quality_.twice > 0.0 && part(random_) < quality_.twice)
      add(arrives_s + quality_.delay_s * part(random_), message);
  }
  /// The one that has arrived last since the last call.
  std::optional<T> take(double now_s) {
    std::optional<T> newest;
    for (; !on_the_way_.empty() && on_the_way_.front().arrives_s <= now_s; on_the_way_.pop_front())
      newest = on_the_way_.front().message;
    return newest;
  }
  /// From now on nothing arrives, nor what is on the way; or again.
  void cut(bool is_cut) {
    is_cut_ = is_cut;
    if (is_cut) on_the_way_.clear();
  }

 private:
  struct Arrival {
    double arrives_s;
    T message;
  };
  void add(double arrives_s, const T& message) {
    const auto after =
        std::upper_bound(on_the_way_.begin(), on_the_way_.end(), arrives_s,
                         [](double t_s, const Arrival& other) { return t_s < other.arrives_s; });
    on_the_way_.insert(after, {arrives_s, message});
  }

  LinkQuality quality_;
  std::mt19937 random_;
  double last_s_ = 0.0;
  bool is_cut_ = false;
  std::deque<Arrival> on_the_way_;
};

}  // namespace palpable::session
