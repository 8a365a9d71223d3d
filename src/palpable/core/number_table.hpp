// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpable {

/// Rows of finite numbers under named columns: what a CSV file holds of interest.
struct NumberTable {
  std::size_t columns = 0;
  /// Row by row.
  std::vector<double> values;
  std::size_t rows() const { return columns == 0 ? 0 : values.size() / columns; }
  std::span<const double> row(std::size_t i) const { return std::span(values).subspan(i * columns, columns); }
};

/// The columns `wanted`, in that order, of a CSV text whose first line names its columns in any order; other
/// columns are skipped, empty lines too. Takes CRLF, a byte-order mark, blanks and quotes round a field;
/// numbers have a decimal point whatever the locale. Errors, invalid_input with the line's number and no
/// place: a column missing, too few fields, a field that is no finite number, no rows.
Result<NumberTable> parse_number_table(std::string_view csv, std::span<const std::string_view> wanted);

/// Whether the first line of a CSV text names all of these columns.
bool has_columns(std::string_view csv, std::span<const std::string_view> names);

/// Appends the shortest text that reads back as exactly this double, whatever the locale; nothing if it is
/// not finite.
void append_number(std::string& text, double value);

}  // namespace palpable
