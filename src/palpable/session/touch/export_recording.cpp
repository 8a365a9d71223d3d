// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/export_recording.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/text/number_table.hpp"
#include "palpable/device/recording/recording.hpp"
#include "palpable/formats/packing/npz.hpp"
#include "palpable/session/touch/recording_header.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace palpable::session {
namespace {

using device::TouchSample;

/// Three columns of a tick and their names.
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

/// By time; the hand's tick before those of further probes at the same time.
void sort_by_time(std::vector<TouchSample>& ticks) {
  std::stable_sort(ticks.begin(), ticks.end(),
                   [](const TouchSample& a, const TouchSample& b) { return a.t_s < b.t_s; });
}

std::vector<TouchSample> ticks_of(const device::Recording& recording) {
  std::vector<TouchSample> all = recording.ticks;
  all.insert(all.end(), recording.further.begin(), recording.further.end());
  sort_by_time(all);
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

/// Writes the lines of a table one by one.
class CsvLines {
 public:
  explicit CsvLines(AtomicFile& file) : file_(file) {
    for (const auto& column : kNumbers) text_ += std::string(column.name) + ",";
    for (const auto& column : kVectors)
      for (const char* axis : {"_x", "_y", "_z"})
        text_ += std::string(column.name) + axis + column.unit + ",";
    end_line();
  }
  Result<void> add(const std::vector<TouchSample>& ticks) {
    constexpr std::size_t kEnough_bytes = std::size_t{1} << 20U;
    for (const auto& tick : ticks) {
      for (const auto& column : kNumbers) add(column.of(tick));
      for (const auto& column : kVectors) {
        const Vec3 v = column.of(tick);
        add(v.x);
        add(v.y);
        add(v.z);
      }
      end_line();
      if (text_.size() < kEnough_bytes) continue;
      if (auto written = flush(); !written) return written;
    }
    return {};
  }
  Result<void> flush() {
    auto written = file_.write(as_bytes(text_));
    text_.clear();
    return written;
  }

 private:
  void add(double value) {
    append_number(text_, value);
    text_ += ',';
  }
  void end_line() { text_.back() = '\n'; }

  AtomicFile& file_;
  std::string text_;
};

Result<ExportedRecording> export_csv(const std::filesystem::path& recording,
                                     const std::filesystem::path& output, const Work& work) {
  auto reader = device::RecordingReader::open(recording);
  if (!reader) return std::move(reader).error();
  auto file = AtomicFile::create(output);
  if (!file) return std::move(file).error();
  CsvLines lines(*file);
  ExportedRecording exported;
  // Ticks that the writer took from the ring together are stored as those of the hand, followed by those of
  // further probes.
  std::vector<TouchSample> together;
  bool has_further = false;
  const auto write_together = [&] {
    if (has_further) sort_by_time(together);
    auto written = lines.add(together);
    together.clear();
    has_further = false;
    return written;
  };
  while (const device::Recording* piece = (*reader)->next()) {
    if (work.cancelled()) return Work::interrupted();
    work.report((*reader)->fraction(), "writing the table");
    if (!piece->ticks.empty())
      if (auto written = write_together(); !written) return std::move(written).error();
    exported.ticks += piece->ticks.size();
    together.insert(together.end(), piece->ticks.begin(), piece->ticks.end());
    together.insert(together.end(), piece->further.begin(), piece->further.end());
    has_further = has_further || !piece->further.empty();
  }
  if (auto valid = (*reader)->check_end(); !valid) return std::move(valid).error();
  if (auto written = write_together(); !written) return std::move(written).error();
  if (auto written = lines.flush(); !written) return std::move(written).error();
  if (auto written = file->commit(); !written) return std::move(written).error();
  exported.lost = (*reader)->lost();
  exported.complete = (*reader)->end() == device::RecordingEnd::complete;
  return exported;
}

Result<ExportedRecording> export_npz(const std::filesystem::path& file, const std::filesystem::path& output) {
  const auto recording = device::read_recording(file);
  if (!recording) return recording.error();
  if (auto written = formats::write_npz(output, recording_npz(*recording)); !written)
    return std::move(written).error();
  return ExportedRecording{recording->ticks.size(), recording->lost, recording->complete};
}

}  // namespace

Result<ExportedRecording> export_recording(const std::filesystem::path& recording,
                                           const std::filesystem::path& output, const Work& work) {
  if (const auto session = read_recorded_session(recording); !session) return session.error();
  if (output.extension() == ".csv") return export_csv(recording, output, work);
  if (output.extension() == ".npz") return export_npz(recording, output);
  return Error{ErrorCode::usage, "a recording is exported as .csv or .npz", output.string()};
}

}  // namespace palpable::session
