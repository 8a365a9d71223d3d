// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/view/report_page.hpp"

#include <gmock/gmock.h>

namespace palpable::draw {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<std::byte> bytes(std::string_view text) {
  std::vector<std::byte> out;
  for (const char c : text) out.push_back(static_cast<std::byte>(c));
  return out;
}

TEST(ReportPage, HoldsPicturesAsDataWithAlternativeTexts) {
  // RFC 4648, section 10.
  for (const auto& [plain, coded] :
       {std::pair("f", "Zg=="), {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}}) {
    ReportPage page{"T", "I", {{"H", {}, {}, {{bytes(plain), "a \"house\"", "c"}}, {}}}};
    const std::string html = html_of(page);
    EXPECT_THAT(html, HasSubstr(std::string("base64,") + coded + "\""));
    EXPECT_THAT(html, HasSubstr("alt=\"a &quot;house&quot;\""));
  }
}

TEST(ReportPage, StatesItsLanguageAndHasHeadingsAndHeaderCells) {
  ReportPage page{"Model <1>",
                  "I & you",
                  {{"Figures", {"p"}, {"one"}, {}, ReportTable{"c", {"what", "value"}, {{"a", "1"}}}}}};
  const std::string html = html_of(page);
  EXPECT_THAT(html, HasSubstr("<html lang=\"en\">"));
  EXPECT_THAT(html, HasSubstr("<title>Model &lt;1&gt;</title>"));
  EXPECT_THAT(html, HasSubstr("<h1>Model &lt;1&gt;</h1>"));
  EXPECT_THAT(html, HasSubstr("<h2>Figures</h2>"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"col\">what</th>"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">a</th><td>1</td>"));
  EXPECT_THAT(html, HasSubstr("<li>one</li>"));
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_THAT(html, Not(HasSubstr("<script>")));
}

TEST(ReportPage, AsksForAKnownLengthByTwoPlacesOfAPicture) {
  ReportPage page{"T", "I", {{"Size", {}, {}, {}, {}, ReportLength{{bytes("f"), "a frame", "c"}, 40, 2.0}}}};
  const std::string html = html_of(page);
  EXPECT_THAT(html, HasSubstr("data-frame=\"40\" data-scale=\"2.0"));
  EXPECT_THAT(html, HasSubstr("<label>Distance in mm <input"));
  EXPECT_THAT(html, HasSubstr("<script>"));
  EXPECT_THAT(html, HasSubstr("mm between"));
}

}  // namespace
}  // namespace palpable::draw
