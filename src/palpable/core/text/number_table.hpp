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

/// Rows of finite numbers in selected columns of a CSV file.
struct NumberTable {
  std::size_t columns = 0;
  /// Row by row.
  std::vector<double> values;
  std::size_t rows() const { return columns == 0 ? 0 : values.size() / columns; }
  std::span<const double> row(std::size_t i) const { return std::span(values).subspan(i * columns, columns); }
};

/// Reads the columns `wanted`, in that order, from a CSV text whose first line names its columns in any
/// order. Other columns and empty lines are skipped. CRLF, a byte-order mark, spaces, and quotes around a
/// field are accepted. The decimal separator is a point in every locale. Errors (invalid_input, with the line
/// number and no place): a missing column, too few fields, a field that is not a finite number, no rows.
Result<NumberTable> parse_number_table(std::string_view csv, std::span<const std::string_view> wanted);

/// Whether the first line of a CSV text names all of these columns.
bool has_columns(std::string_view csv, std::span<const std::string_view> names);

/// Appends the shortest text that converts back to exactly this double, in every locale; appends nothing if
/// the value is not finite.
void append_number(std::string& text, double value);

}  // namespace palpable
