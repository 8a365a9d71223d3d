// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/recording_header.hpp"

#include "palpable/core/text/json_integer.hpp"
#include "palpable/device/recording/recording.hpp"
#include "palpable/device/recording/traits_json.hpp"
#include "palpable/haptics/safety/passivity.hpp"
#include "palpable/haptics/tick/velocity.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

namespace palpable::session {
namespace {

using HeaderJson = nlohmann::ordered_json;
constexpr int kFormat = 2;

/// A number of the tick's options and its name.
struct TickNumber {
  std::string_view name;
  double haptics::TickOptions::*value;
};
constexpr TickNumber kTickNumbers[]{
    {"max_force_N", &haptics::TickOptions::max_force_N},
    {"max_torque_rate_Nm_per_s", &haptics::TickOptions::max_torque_rate_Nm_per_s},
    {"max_turn_rad_per_s", &haptics::TickOptions::max_rotation_rad_per_s},
    {"max_force_rate_N_per_s", &haptics::TickOptions::max_force_rate_N_per_s},
    {"fade_s", &haptics::TickOptions::fade_s},
    {"ramp_down_s", &haptics::TickOptions::ramp_down_s},
    {"ramp_up_s", &haptics::TickOptions::ramp_up_s},
    {"max_speed_m_per_s", &haptics::TickOptions::max_speed_m_per_s},
    {"max_pointer_speed_m_per_s", &haptics::TickOptions::max_pointer_speed_m_per_s},
    {"reach_in_workspaces", &haptics::TickOptions::reach_in_workspaces},
    {"stall_s", &haptics::TickOptions::stall_s},
    {"max_rise_time_s", &haptics::TickOptions::max_rise_time_s},
    {"max_transient_of_force", &haptics::TickOptions::max_transient_of_force},
    {"impact_speed_m_per_s", &haptics::TickOptions::impact_speed_m_per_s}};

HeaderJson tick_to_json(const haptics::TickOptions& tick) {
  HeaderJson json;
  for (const TickNumber& number : kTickNumbers) {
    const double value = tick.*number.value;
    json[std::string(number.name)] = std::isfinite(value) ? HeaderJson(value) : HeaderJson(nullptr);
  }
  json["glitch_readings"] = tick.glitch_readings;
  json["ramp_loads"] = tick.ramp_loads;
  json["passivity"] = tick.passivity == haptics::Passivity::control ? "control" : "observe";
  return json;
}

haptics::TickOptions tick_from_json(const HeaderJson& json) {
  haptics::TickOptions tick;
  for (const TickNumber& number : kTickNumbers) {
    const auto value = json.find(std::string(number.name));
    // An older program did not have this option, so its recording does not depend on it.
    if (value == json.end()) continue;
    tick.*number.value = value->is_null() ? std::numeric_limits<double>::infinity() : value->get<double>();
  }
  tick.glitch_readings = integer_from<int>(json.at("glitch_readings"));
  // No ramp of an older program did.
  tick.ramp_loads = json.value("ramp_loads", false);
  tick.passivity = json.at("passivity").get<std::string>() == "observe" ? haptics::Passivity::observe
                                                                        : haptics::Passivity::control;
  return tick;
}

/// Description of this program's estimators.
HeaderJson estimator_json() {
  return {{"velocity", "first-order adaptive windowing, end-fit"},
          {"samples", haptics::VelocityEstimator::kSamples},
          {"shortest", "half the greatest rise time"},
          {"acts_after", "delay and half a tick"},
          {"gains", "mean acceleration of 2 d + 1 ticks"},
          {"reserve_s", haptics::PassivityObserver::kReserve_s}};
}

RecordedSession session_from_json(const HeaderJson& json, const std::string& text) {
  RecordedSession session;
  session.format = json.contains("format") ? integer_from<int>(json.at("format")) : 1;
  session.made_by = json.value("made_by", "");
  session.seed = json.contains("seed") ? integer_from<std::uint64_t>(json.at("seed")) : 1;
  session.rate_hz = json.value("rate_hz", 1000.0);
  session.as_published = json.value("as_published", "");
  session.device_name = json.value("device", "");
  if (session.format < kFormat) return session;
  session.command = json.at("command").get<std::vector<std::string>>();
  session.device_url = json.at("device_url").get<std::string>();
  session.tick = tick_from_json(json.at("tick"));
  session.traits = device::recorded_traits(text);
  if (json.contains("traits") && !session.traits) throw std::invalid_argument("the device's traits");
  session.has_our_estimator = json.at("estimator") == estimator_json();
  return session;
}

Result<void> check_values(const RecordedSession& session) {
  constexpr double kMostRate_Hz = 100'000.0;
  if (!(session.rate_hz > 0.0 && session.rate_hz <= kMostRate_Hz))
    return invalid_input("a loop rate of " + std::to_string(session.rate_hz) + " Hz");
  if (auto valid = haptics::check(session.tick); !valid) return valid;
  return session.traits ? device::check(*session.traits) : Result<void>{};
}

}  // namespace

std::string header_json(const RecordedSession& session) {
  HeaderJson json{{"format", kFormat},
                  {"made_by", session.made_by},
                  {"command", session.command},
                  {"seed", session.seed},
                  {"rate_hz", session.rate_hz},
                  {"device", session.traits ? session.traits->name : session.device_name},
                  {"device_url", session.device_url},
                  {"as_published", session.as_published},
                  {"tick", tick_to_json(session.tick)},
                  {"estimator", estimator_json()}};
  if (session.traits) json["traits"] = HeaderJson::parse(device::traits_json(*session.traits));
  return json.dump(-1, ' ', false, HeaderJson::error_handler_t::replace);
}

Result<RecordedSession> parse_header(const std::string& json) {
  try {
    RecordedSession session = session_from_json(HeaderJson::parse(json), json);
    if (session.format > kFormat)
      return invalid_input("is a recording of a newer format than this program reads");
    if (auto valid = check_values(session); !valid)
      return invalid_input("is a recording whose header states what cannot be: " + valid.error().message);
    return session;
  } catch (const HeaderJson::exception&) {
    return invalid_input("is a recording whose header cannot be read");
  } catch (const std::invalid_argument& what) {
    return invalid_input(std::string("is a recording whose header cannot be read: ") + what.what());
  }
}

Result<RecordedSession> read_recorded_session(const std::filesystem::path& file) {
  const auto reader = device::RecordingReader::open(file);
  if (!reader) return reader.error();
  auto session = parse_header((*reader)->header_json());
  if (!session) return invalid_input(session.error().message, file.string());
  return session;
}

}  // namespace palpable::session
