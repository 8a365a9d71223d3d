// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/inverse3/inverse3_messages.hpp"

#include "palpable/core/text/plain_text.hpp"
#include "palpable/device/transport/vendor_text.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

namespace palpable::device {
namespace {

using InverseJson = nlohmann::json;

/// A state has five levels.
constexpr int kDeepest = 12;
constexpr std::size_t kMostFilters = 8;

/// The member of an object, or null.
const InverseJson& member(const InverseJson& object, const char* name) {
  static const InverseJson none;
  if (!object.is_object()) return none;
  const auto found = object.find(name);
  return found == object.end() ? none : *found;
}

std::optional<Vec3> vector_in(const InverseJson& object) {
  const auto& x = member(object, "x");
  const auto& y = member(object, "y");
  const auto& z = member(object, "z");
  if (!x.is_number() || !y.is_number() || !z.is_number()) return std::nullopt;
  const Vec3 vector{x.get<double>(), y.get<double>(), z.get<double>()};
  if (!is_finite(vector)) return std::nullopt;
  return vector;
}

std::optional<bool> truth_in(const InverseJson& value) {
  if (!value.is_boolean()) return std::nullopt;
  return value.get<bool>();
}

bool is_on(const InverseJson& setting) {
  return truth_in(setting).value_or(false) || truth_in(member(setting, "enabled")).value_or(false);
}

/// Whether a text may be nested more deeply than a state is. Brackets in its strings count too: no name has
/// so many.
bool is_deep(std::string_view message) {
  int depth = 0;
  for (const char c : message) {
    depth += c == '[' || c == '{' ? 1 : 0;
    depth -= c == ']' || c == '}' ? 1 : 0;
    if (depth > kDeepest) return true;
  }
  return false;
}

/// Null for a message that is none, that is nested too deeply, or too long: the driver's thread cannot send
/// zero while it parses.
InverseJson parsed(std::string_view message) {
  constexpr std::size_t kLongestParsed_bytes = 65536;
  if (message.size() > kLongestParsed_bytes || is_deep(message)) return {};
  bool too_deep = false;
  const auto watch_depth = [&](int depth, InverseJson::parse_event_t, InverseJson&) {
    too_deep = too_deep || depth > kDeepest;
    return depth <= kDeepest;
  };
  InverseJson json = InverseJson::parse(message, watch_depth, false);
  if (json.is_discarded() || too_deep) return {};
  return json;
}

/// The name is a text that can be shown.
bool can_be_shown(const InverseJson& name) {
  return name.is_string() && palpable::device::can_be_shown(name.get_ref<const std::string&>());
}

InverseJson as_json(Vec3 v) { return {{"x", v.x}, {"y", v.y}, {"z", v.z}}; }

}  // namespace

std::optional<Inverse3State> parse_inverse3_state(std::string_view message, std::string_view device_id) {
  const InverseJson json = parsed(message);
  const auto& devices = member(json, "inverse3");
  if (!devices.is_array()) return std::nullopt;
  for (const auto& device : devices) {
    const auto& id = member(device, "device_id");
    if (!can_be_shown(id) || (!device_id.empty() && id.get_ref<const std::string&>() != device_id)) continue;
    Inverse3State state;
    state.device_id = id.get<std::string>();
    const auto& now = member(device, "state");
    state.position_m = vector_in(member(now, "cursor_position"));
    state.force_N = vector_in(member(now, "current_cursor_force"));
    const auto& status = member(device, "status");
    state.calibrated = truth_in(member(status, "calibrated"));
    state.ready = truth_in(member(status, "ready"));
    const auto& settings = member(device, "config");
    if (settings.is_object())
      for (const auto& [name, setting] : settings.items())
        if (is_on(setting) && can_be_shown(name) && state.filters.size() < kMostFilters)
          state.filters.push_back(name);
    return state;
  }
  return std::nullopt;
}

bool is_inverse3_list(std::string_view message) { return member(parsed(message), "inverse3").is_array(); }

std::string inverse3_command(std::string_view device_id, Vec3 force_N, Inverse3Form form, bool first) {
  InverseJson force = InverseJson::object();
  if (form != Inverse3Form::values) force["vector"] = as_json(force_N);
  if (form != Inverse3Form::vector) force["values"] = as_json(force_N);
  InverseJson message;
  if (first) message["session"]["configure"]["profile"]["name"] = "Palpable";
  message["inverse3"] = InverseJson::array(
      {{{"device_id", std::string(device_id)}, {"commands", {{"set_cursor_force", std::move(force)}}}}});
  return message.dump(-1, ' ', false, InverseJson::error_handler_t::replace);
}

}  // namespace palpable::device
