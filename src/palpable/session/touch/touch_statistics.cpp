// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/touch_statistics.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

namespace palpable::session {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json percentiles(const haptics::Percentiles& of) {
  return {
      {"p50", number(of.p50)}, {"p99", number(of.p99)}, {"p99_9", number(of.p99_9)}, {"max", number(of.max)}};
}

Json latency_json(const haptics::LatencySummary& latency) {
  const auto ms = [&](double ns) { return latency.count > 0 ? Json(1e-6 * ns) : Json(nullptr); };
  return {{"p50", ms(latency.p50_ns)}, {"p99", ms(latency.p99_ns)}, {"max", ms(latency.max_ns)}};
}

Json live_json(const LiveStatistics& live) {
  Json json{{"frames", live.frames},
            {"dropped", live.dropped},
            {"fps", number(live.fps)},
            {"latency_ms", latency_json(live.latency)},
            {"stale_s", number(live.stale_s)}};
  if (const auto& robot = live.robot)
    json["robot"] = {{"commands", robot->commands},
                     {"moving_commands", robot->moving_commands},
                     {"started", robot->is_started},
                     {"sounds", robot->sounds},
                     {"picture_age_ms", latency_json(robot->picture_age)}};
  if (live.robot && live.robot->arm)
    json["robot"]["arm"] = {{"commands", live.robot->arm->commands},
                            {"near_views", live.robot->arm->near_views}};
  if (const auto& memory = live.memory)
    json["memory"] = {{"share", memory->share}, {"map_mib", memory->map_mib}, {"lost", memory->lost}};
  return json;
}

Json hand_json(const TouchStatistics& statistics) {
  const auto& servo = statistics.servo;
  const auto& touch = servo.touch;
  const auto& cause = servo.missed_by_cause;
  Json json;
  json["servo"] = {{"ticks", touch.ticks},
                   {"rate_hz", number(servo.rate_hz)},
                   {"rested_s", number(servo.rested_s)},
                   {"missed", servo.missed},
                   {"stalls", touch.stalls},
                   {"missed_by_cause",
                    {{"late_wake", cause[0]},
                     {"held_up_waiting", cause[1]},
                     {"held_up_in_tick", cause[2]},
                     {"slow_tick", cause[3]}}},
                   {"period_us", percentiles(servo.period_us)},
                   {"compute_us", percentiles(servo.compute_us)}};
  json["force"] = {{"max_N", number(touch.max_force_N)},
                   {"clamped_ticks", touch.force_capped_ticks},
                   {"motor_heat", number(touch.heat)},
                   {"rate_capped_ticks", touch.rise_limited_ticks}};
  json["energy"] = {{"made_max_J", number(touch.made_max_J)},
                    {"made_max_without_controller_J", number(touch.made_max_without_controller_J)},
                    {"work_made_max_J", number(touch.work_made_max_J)},
                    {"work_since_zero_force_max_J", number(touch.work_since_zero_force_max_J)},
                    {"controlled_ticks", touch.passivity_ticks},
                    {"rise_limit_withheld_max_J", number(touch.withheld_max_J)},
                    {"scene_change_J", number(touch.scene_change_J)}};
  json["contact_ticks"] = touch.contact_ticks;
  json["fault_ticks"] = touch.fault_ticks;
  json["allocations_in_ticks"] = servo.allocations_in_ticks;
  json["seconds_to_scene"] = number(statistics.seconds_to_scene);
  json["seconds_to_first_force"] = number(statistics.seconds_to_first_force);
  json["device"] = statistics.device;
  json["realtime_priority"] = statistics.realtime_priority;
  json["memory_lock"] = statistics.memory_lock;
  return json;
}

}  // namespace

std::string to_json(const TouchStatistics& statistics) {
  Json json = hand_json(statistics);
  if (statistics.live) json["live"] = live_json(*statistics.live);
  if (!statistics.further_hands.empty()) json["further_hands"] = Json::array();
  for (const TouchStatistics& hand : statistics.further_hands)
    json["further_hands"].push_back(hand_json(hand));
  return json.dump();
}

}  // namespace palpable::session
