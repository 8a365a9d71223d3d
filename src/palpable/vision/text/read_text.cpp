// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/read_text.hpp"

#include "palpable/vision/text/agreement.hpp"
#include "palpable/vision/text/compared_form.hpp"
#include "palpable/vision/text/straight_text.hpp"
#include "palpable/vision/text/tesseract.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>

namespace palpable::vision {
namespace {

using Kind = StraightText::Kind;

/// What most of the readings say; nothing if fewer than `least_count` agree.
ReadingVote agreed(const std::vector<Reading>& readings, int least_count) {
  const std::vector<ReadingVote> votes = votes_of_readings(readings);
  const auto best =
      std::max_element(votes.begin(), votes.end(),
                       [](const ReadingVote& a, const ReadingVote& b) { return a.weight < b.weight; });
  return best == votes.end() || best->count < least_count ? ReadingVote{} : *best;
}

double weight_of(const std::vector<Reading>& readings) {
  double most = 0.0;
  for (const ReadingVote& vote : votes_of_readings(readings)) most = std::max(most, vote.weight);
  return most;
}

/// The readings of one line, all in the same direction.
struct Readings {
  std::vector<Reading> all;
  bool reversed = false;
};

/// Whether a line is so level that its lettering is read to the right unless the whole picture is upside
/// down.
bool is_level(const TextLine& line, const ReadTextOptions& options) {
  const MapPoint a = line.centre.front(), b = line.centre.back();
  return std::abs(b.y - a.y) <= std::tan(options.level_deg * std::numbers::pi / 180.0) * std::abs(b.x - a.x);
}

bool leftwards(const TextLine& line) { return line.centre.back().x < line.centre.front().x; }

/// Whether a line was read with enough confidence.
bool is_sure(const Readings& line, const Reader& reader, const ReadTextOptions& options) {
  const int least = reader.languages.size() > 1 ? 2 : 1;
  return agreed(line.all, least).best.confidence >= options.sure;
}

/// The lines that are read to the left, too: the unsure ones, but for level ones of a picture whose level
/// lines are mostly read to the right with confidence.
std::vector<std::size_t> maybe_upside_down(const std::vector<Readings>& read, std::span<const TextLine> lines,
                                           const Reader& reader, const ReadTextOptions& options) {
  std::vector<std::size_t> unsure;
  std::size_t level = 0, level_and_sure = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const bool sure = is_sure(read[i], reader, options);
    if (!sure) unsure.push_back(i);
    if (!is_level(lines[i], options) || read[i].all.empty()) continue;
    ++level;
    level_and_sure += sure ? 1 : 0;
  }
  constexpr double kUpright = 0.25;
  if (static_cast<double>(level_and_sure) >= std::max(1.0, kUpright * static_cast<double>(level)))
    std::erase_if(unsure, [&](std::size_t i) { return is_level(lines[i], options); });
  return unsure;
}

/// Reads each line to the right, and to the left where that is unsure.
Result<std::vector<Readings>> read_both_ways(const StraightText& straight, std::span<const TextLine> lines,
                                             const Reader& reader, const ReadTextOptions& options,
                                             const Work& work) {
  std::vector<Readings> out(lines.size());
  std::vector<std::size_t> numbers(lines.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  for (const bool again : {false, true}) {
    if (again) numbers = maybe_upside_down(out, lines, reader, options);
    std::vector<cv::Mat> pictures;
    pictures.reserve(numbers.size());
    for (const std::size_t i : numbers)
      pictures.push_back(straight.of(lines[i], leftwards(lines[i]) != again, Kind::strokes));
    auto read = read_pictures(pictures, reader, options, work);
    if (!read) return read.error();
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      Readings& line = out[numbers[k]];
      if (again && weight_of((*read)[k]) <= weight_of(line.all)) continue;
      line = {std::move((*read)[k]), leftwards(lines[numbers[k]]) != again};
    }
  }
  return out;
}

/// Whether too few of the readings of a line agree.
bool is_unsure(const std::vector<Reading>& readings, const ReadTextOptions& options) {
  return agreed(readings, 1).count < options.agreeing_part * static_cast<double>(readings.size());
}

/// Reads other pictures of the lines that said something, one of them only where readings differ.
Result<void> read_more(std::vector<Readings>& readings, const StraightText& straight,
                       std::span<const TextLine> lines, Kind kind, const Reader& reader,
                       const ReadTextOptions& options, const Work& work) {
  std::vector<std::size_t> numbers;
  std::vector<cv::Mat> pictures;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (weight_of(readings[i].all) <= 0.0 || (kind == Kind::covered && !is_unsure(readings[i].all, options)))
      continue;
    numbers.push_back(i);
    pictures.push_back(straight.of(lines[i], readings[i].reversed, kind));
  }
  auto read = read_pictures(pictures, reader, options, work);
  if (!read) return read.error();
  for (std::size_t k = 0; k < numbers.size(); ++k)
    for (Reading& reading : (*read)[k]) readings[numbers[k]].all.push_back(std::move(reading));
  return {};
}

Result<std::vector<Readings>> all_readings(const Raster<Rgb8>& picture, std::span<const TextLine> lines,
                                           const Reader& reader, const ReadTextOptions& options,
                                           const Work& work, std::span<const Rgb8> grounds) {
  const StraightText straight(picture, grounds, options);
  auto readings = read_both_ways(straight, lines, reader, options, work);
  if (!readings) return readings.error();
  // With one language, a third picture makes up for the readings of others.
  std::vector<Kind> kinds{Kind::sharpened};
  if (reader.languages.size() == 1) kinds.push_back(Kind::stretched);
  kinds.push_back(Kind::covered);
  for (const Kind kind : kinds)
    if (auto more = read_more(*readings, straight, lines, kind, reader, options, work); !more)
      return more.error();
  return readings;
}

/// What was read, each form once.
std::vector<std::string> different_texts(const std::vector<Reading>& readings) {
  std::vector<std::string> forms, texts;
  for (const Reading& reading : readings) {
    const std::string form = compared_form(reading.text);
    if (reading.text.empty() || std::find(forms.begin(), forms.end(), form) != forms.end()) continue;
    forms.push_back(form);
    texts.push_back(reading.text);
  }
  return texts;
}

}  // namespace

Result<TextReading> read_text_lines(const Raster<Rgb8>& picture, std::span<const TextLine> lines,
                                    const ReadTextOptions& options, const Work& work,
                                    std::span<const Rgb8> grounds) {
  TextReading out;
  out.lines.resize(lines.size());
  if (lines.empty()) return out;
  const auto reader = installed_reader(options.languages);
  if (!reader) {
    out.notes.emplace_back(
        "Names were not read: that needs the program tesseract and its language data (in Debian: "
        "tesseract-ocr, and "
        "tesseract-ocr-deu for German).");
    return out;
  }
  const auto readings = all_readings(picture, lines, *reader, options, work, grounds);
  if (!readings && readings.error().code == ErrorCode::interrupted) return readings.error();
  if (!readings) {
    out.notes.emplace_back("Names were not read: " + readings.error().message +
                           "; check its language data (in Debian: tesseract-ocr-eng).");
    return out;
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Readings& line = (*readings)[i];
    // One in four, at least two.
    constexpr int kLeast = 2, kPart = 4;
    const int readings_count = static_cast<int>(line.all.size());
    ReadingVote vote = agreed(line.all, std::max(kLeast, (readings_count + kPart - 1) / kPart));
    out.lines[i] = {std::move(vote.best.text), vote.best.confidence, line.reversed, different_texts(line.all),
                    vote.weight};
  }
  return out;
}

}  // namespace palpable::vision
