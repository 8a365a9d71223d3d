// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/export_recording.hpp"

#include "palpable/core/atomic_file.hpp"
#include "palpable/core/byte_reader.hpp"
#include "palpable/core/number_table.hpp"
#include "palpable/formats/packing/npz.hpp"

#include <algorithm>
#include <vector>

namespace palpable::session {
namespace {

using device::TouchSample;

/// Three columns of a tick, and what they are called.
struct VectorColumn {
  const char* name;
  const char* unit;
  Vec3 (*of)(const TouchSample&);
};
constexpr VectorColumn kVectors[] = {
    {"device", "_m", [](const TouchSample& t) { return t.device_position.v; }},
    {"position", "_m", [](const TouchSample& t) { return t.position.v; }},
    {"velocity", "_m_per_s", [](const TouchSample& t) { return t.velocity_m_per_s.v; }},
    {"proxy", "_m", [](const TouchSample& t) { return t.proxy.v; }},
    {"raw_force", "_N", [](const TouchSample& t) { return t.raw_force_N.v; }},
    {"written_force", "_N", [](const TouchSample& t) { return t.written_force_N.v; }},
};

struct NumberColumn {
  const char* name;
  double (*of)(const TouchSample&);
};
constexpr NumberColumn kNumbers[] = {
    {"tick", [](const TouchSample& t) { return static_cast<double>(t.tick); }},
    {"t_s", [](const TouchSample& t) { return t.t_s; }},
    {"dt_s", [](const TouchSample& t) { return t.dt_s; }},
    {"energy_J", [](const TouchSample& t) { return t.energy_J; }},
    {"flags", [](const TouchSample& t) { return static_cast<double>(t.flags); }},
    {"buttons", [](const TouchSample& t) { return static_cast<double>(t.buttons); }},
    {"program", [](const TouchSample& t) { return static_cast<double>(t.scene_id); }},
    {"label", [](const TouchSample& t) { return static_cast<double>(t.label); }},
    {"status", [](const TouchSample& t) { return static_cast<double>(t.status); }},
    {"probe", [](const TouchSample& t) { return static_cast<double>(t.probe); }},
};

/// All probes' ticks by time, the hand's before the others' of the same time.
std::vector<TouchSample> ticks_of(const device::Recording& recording) {
  std::vector<TouchSample> all = recording.ticks;
  all.insert(all.end(), recording.further.begin(), recording.further.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const TouchSample& a, const TouchSample& b) { return a.t_s < b.t_s; });
  return all;
}

formats::Npz recording_npz(const device::Recording& recording) {
  formats::Npz arrays;
  const auto ticks = ticks_of(recording);
  std::vector<double> values;
  for (const auto& column : kNumbers) {
    values.clear();
    for (const auto& tick : ticks) values.push_back(column.of(tick));
    arrays[column.name] = formats::npy_array(values);
  }
  for (const auto& column : kVectors) {
    values.clear();
    for (const auto& tick : ticks) {
      const Vec3 v = column.of(tick);
      values.insert(values.end(), {v.x, v.y, v.z});
    }
    arrays[std::string(column.name) + column.unit] = formats::npy_array(values, 3);
  }
  return arrays;
}

}  // namespace

std::string recording_csv(const device::Recording& recording) {
  std::string text;
  const auto end_line = [&] { text.back() = '\n'; };
  for (const auto& column : kNumbers) text += std::string(column.name) + ",";
  for (const auto& column : kVectors)
    for (const char* axis : {"_x", "_y", "_z"}) text += std::string(column.name) + axis + column.unit + ",";
  end_line();
  for (const auto& tick : ticks_of(recording)) {
    const auto add = [&](double value) {
      append_number(text, value);
      text += ',';
    };
    for (const auto& column : kNumbers) add(column.of(tick));
    for (const auto& column : kVectors) {
      const Vec3 v = column.of(tick);
      add(v.x);
      add(v.y);
      add(v.z);
    }
    end_line();
  }
  return text;
}

Result<void> export_recording(const device::Recording& recording, const std::filesystem::path& file) {
  if (file.extension() == ".csv") return write_file_atomically(file, as_bytes(recording_csv(recording)));
  if (file.extension() == ".npz") return formats::write_npz(file, recording_npz(recording));
  return Error{ErrorCode::usage, "a recording is exported as .csv or .npz", file.string()};
}

}  // namespace palpable::session
