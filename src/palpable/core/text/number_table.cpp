// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/text/number_table.hpp"

#include "palpable/core/text/number_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace palpable {
namespace {

/// Cuts `text` at its first `mark`: returns the part before it and keeps the part after it.
std::string_view take_until(std::string_view& text, char mark) {
  const std::size_t end = text.find(mark);
  const std::string_view head = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  return head;
}

std::string_view trimmed(std::string_view field) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!field.empty() && blank(field.front())) field.remove_prefix(1);
  while (!field.empty() && blank(field.back())) field.remove_suffix(1);
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
    field = field.substr(1, field.size() - 2);
  return field;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  while (!line.empty()) fields.push_back(trimmed(take_until(line, ',')));
  return fields;
}

/// For each field of a row: its index among the wanted columns, or kSkipped.
constexpr std::size_t kSkipped = static_cast<std::size_t>(-1);

Result<std::vector<std::size_t>> places_of(std::string_view header,
                                           std::span<const std::string_view> wanted) {
  const auto names = fields_of(header);
  std::vector<std::size_t> places(names.size(), kSkipped);
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const auto found = std::find(names.begin(), names.end(), wanted[k]);
    if (found == names.end())
      return invalid_input("the column " + std::string(wanted[k]) + " is missing in line 1");
    places[static_cast<std::size_t>(found - names.begin())] = k;
  }
  while (!places.empty() && places.back() == kSkipped) places.pop_back();
  return places;
}

std::string_view without_mark(std::string_view csv) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (csv.starts_with(kByteOrderMark)) csv.remove_prefix(kByteOrderMark.size());
  return csv;
}

/// Fills `row`; the error is a sentence without the line number.
Result<void> parse_row(std::string_view line, std::span<const std::size_t> places,
                       std::span<const std::string_view> wanted, std::span<double> row) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i > 0 && line.empty()) return invalid_input("has too few fields");
    const std::string_view field = trimmed(take_until(line, ','));
    if (places[i] == kSkipped) continue;
    const auto value = finite_number(field);
    if (!value)
      return invalid_input(std::string(wanted[places[i]]) + " is not a finite number: '" +
                           std::string(field.substr(0, 40)) + "'");
    row[places[i]] = *value;
  }
  return {};
}

}  // namespace

bool has_columns(std::string_view csv, std::span<const std::string_view> names) {
  csv = without_mark(csv);
  return places_of(take_until(csv, '\n'), names).has_value();
}

Result<NumberTable> parse_number_table(std::string_view csv, std::span<const std::string_view> wanted) {
  csv = without_mark(csv);
  const auto places = places_of(take_until(csv, '\n'), wanted);
  if (!places) return places.error();
  NumberTable table{wanted.size(), {}};
  table.values.reserve(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n') + 1) *
                       wanted.size());
  for (std::size_t number = 2; !csv.empty(); ++number) {
    const std::string_view line = take_until(csv, '\n');
    if (trimmed(line).empty()) continue;
    table.values.resize(table.values.size() + wanted.size());
    const auto parsed = parse_row(line, *places, wanted, std::span(table.values).last(wanted.size()));
    if (!parsed) return invalid_input("line " + std::to_string(number) + ": " + parsed.error().message);
  }
  if (table.values.empty()) return invalid_input("holds no rows below its header");
  return table;
}

void append_number(std::string& text, double value) {
  if (!std::isfinite(value)) return;
  std::array<char, 32> buffer{};
  const auto [end, fault] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  static_cast<void>(fault);  // 32 characters hold every double's shortest text
  text.append(buffer.data(), end);
}

}  // namespace palpable
