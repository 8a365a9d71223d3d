// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace palpable::draw {

/// A picture of a report, PNG.
struct ReportPicture {
  std::vector<std::byte> png;
  /// What it shows, for people who do not see it; not empty.
  std::string alternative;
  std::string caption;
};

/// A picture in which a reader picks two places whose distance is known, by clicks or by typing their
/// coordinates, and the words for the command line that follow from it:
/// --length "D mm between X,Y and X,Y of frame N".
struct ReportLength {
  ReportPicture picture;
  int frame_number = 0;
  /// Pixels of the video per pixel of the picture.
  double scale = 1.0;
};

/// A table with a header in its first row and first column.
struct ReportTable {
  std::string caption;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

struct ReportSection {
  std::string heading;
  std::vector<std::string> paragraphs;
  /// As a list of sentences.
  std::vector<std::string> items;
  std::vector<ReportPicture> pictures;
  std::optional<ReportTable> table;
  std::optional<ReportLength> length = {};
};

struct ReportPage {
  std::string title;
  std::string introduction;
  std::vector<ReportSection> sections;
};

/// The report as one HTML page in English that needs no other file: pictures are data URIs with alternative
/// texts, headings are nested, tables have header cells. All texts are escaped. It has a script only if a
/// section has a length.
std::string html_of(const ReportPage& page);

}  // namespace palpable::draw
