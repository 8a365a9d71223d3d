// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/report_page.hpp"

#include "palpable/core/text/base64.hpp"
#include "palpable/core/text/html_escape.hpp"

#include <algorithm>
#include <cstdint>
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

std::string number_input(std::string_view label) {
  return "<label>" + std::string(label) + " <input type=\"number\" min=\"0\" step=\"any\"></label>\n";
}

std::string html_of(const ReportLength& length) {
  return "<form class=\"length\" data-frame=\"" + std::to_string(length.frame_number) + "\" data-scale=\"" +
         std::to_string(length.scale) + "\">\n" + html_of(length.picture) + "<p>" +
         number_input("First place: x") + number_input("y") + number_input("Second place: x") +
         number_input("y") + number_input("Distance in mm") +
         "</p>\n<p>Add to the command: <output><code></code></output></p>\n</form>\n";
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
  if (section.length) out += html_of(*section.length);
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

// Pixel centres are at integers, in the video as in the picture.
constexpr std::string_view kLengthScript = R"(
for (const form of document.querySelectorAll("form.length")) {
  const picture = form.querySelector("img"), numbers = [...form.querySelectorAll("input")];
  let next = 0;
  const show = () => {
    const [ax, ay, bx, by, mm] = numbers.map((input) => input.value);
    form.querySelector("code").textContent = numbers.every((input) => input.value !== "")
      ? `--length "${mm} mm between ${ax},${ay} and ${bx},${by} of frame ${form.dataset.frame}"` : "";
  };
  picture.style.cursor = "crosshair";
  picture.addEventListener("click", (event) => {
    const box = picture.getBoundingClientRect(), scale = form.dataset.scale * picture.naturalWidth / box.width;
    const place = (at, from) => Math.max(0, (at - from) * scale - 0.5).toFixed(1);
    numbers[next].value = place(event.clientX, box.left);
    numbers[next + 1].value = place(event.clientY, box.top);
    next = next === 0 ? 2 : 0;
    show();
  });
  form.addEventListener("input", show);
  form.addEventListener("submit", (event) => event.preventDefault());
}
)";

bool has_length(const ReportPage& page) {
  return std::any_of(page.sections.begin(), page.sections.end(),
                     [](const ReportSection& section) { return section.length.has_value(); });
}

}  // namespace

std::string html_of(const ReportPage& page) {
  std::string out =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  out += element("title", page.title);
  out += "<style>" + std::string(kStyle) + "</style>\n</head>\n<body>\n<main>\n";
  out += element("h1", page.title) + element("p", page.introduction);
  for (const ReportSection& section : page.sections) out += html_of(section);
  out += "</main>\n";
  if (has_length(page)) out += "<script>" + std::string(kLengthScript) + "</script>\n";
  return out + "</body>\n</html>\n";
}

}  // namespace palpable::draw
