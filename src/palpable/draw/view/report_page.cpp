// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/report_page.hpp"

#include "palpable/core/text/base64.hpp"
#include "palpable/core/text/html_escape.hpp"

#include <string_view>

namespace palpable::draw {
namespace {

std::string element(std::string_view name, std::string_view text) {
  return "<" + std::string(name) + ">" + html_escaped(text) + "</" + std::string(name) + ">\n";
}

std::string html_of(const ReportPicture& picture) {
  return "<figure>\n<img src=\"data:image/png;base64," + base64(picture.png) + "\" alt=\"" +
         html_escaped(picture.alternative) + "\">\n" + element("figcaption", picture.caption) + "</figure>\n";
}

std::string html_of(const ReportTable& table) {
  std::string out = "<table>\n" + element("caption", table.caption) + "<thead><tr>";
  for (const std::string& name : table.header) out += "<th scope=\"col\">" + html_escaped(name) + "</th>";
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i)
      out += i == 0 ? "<th scope=\"row\">" + html_escaped(row[i]) + "</th>"
                    : "<td>" + html_escaped(row[i]) + "</td>";
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table>\n";
}

std::string html_of(const ReportSection& section) {
  std::string out = "<section>\n" + element("h2", section.heading);
  for (const std::string& paragraph : section.paragraphs) out += element("p", paragraph);
  if (!section.items.empty()) {
    out += "<ul>\n";
    for (const std::string& item : section.items) out += element("li", item);
    out += "</ul>\n";
  }
  for (const ReportPicture& picture : section.pictures) out += html_of(picture);
  if (section.table) out += html_of(*section.table);
  return out + "</section>\n";
}

constexpr std::string_view kStyle =
    "body{font:1.05rem/1.5 system-ui,sans-serif;max-width:64rem;margin:2rem auto;padding:0 "
    "1rem;color:#1a1a1a;"
    "background:#fff}h1,h2{line-height:1.2}figure{margin:1rem 0}img{max-width:100%;height:auto;border:1px "
    "solid "
    "#767676}figcaption{color:#444}table{border-collapse:collapse;margin:1rem 0}caption{text-align:left;"
    "font-weight:bold;padding:.3rem 0}th,td{border:1px solid #767676;padding:.3rem .7rem;text-align:left}";

}  // namespace

std::string html_of(const ReportPage& page) {
  std::string out =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  out += element("title", page.title);
  out += "<style>" + std::string(kStyle) + "</style>\n</head>\n<body>\n<main>\n";
  out += element("h1", page.title) + element("p", page.introduction);
  for (const ReportSection& section : page.sections) out += html_of(section);
  return out + "</main>\n</body>\n</html>\n";
}

}  // namespace palpable::draw
