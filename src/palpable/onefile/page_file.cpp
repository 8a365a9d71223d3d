// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/onefile/page_file.hpp"

#include "palpable/core/text/base64.hpp"
#include "palpable/core/text/html_escape.hpp"
#include "palpable/describe/scene_words.hpp"
#include "palpable/formats/picture/jpeg_encoder.hpp"
#include "palpable/formats/picture/png.hpp"
#include "palpable/onefile/gzip.hpp"
#include "palpable/onefile/page_template.hpp"
#include "palpable/onefile/scene_bytes.hpp"
#include "palpable/page/host.hpp"
#include "palpable/page/protocol.hpp"

#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace palpable::onefile {
namespace {

/// A picture as the page shows it: a JPEG, or a PNG where that is smaller (drawings). Empty for an empty one.
Result<std::vector<std::byte>> picture_file(const Raster<Rgb8>& whole) {
  if (whole.empty()) return std::vector<std::byte>();
  constexpr int kQuality = 88;
  const auto picture = page::protocol::thinned(whole, page::kLongestPictureSide);
  auto jpeg = formats::encode_jpeg(picture, kQuality);
  if (!jpeg) return jpeg;
  auto png = formats::encode_png(picture);
  if (!png) return png;
  return png->size() < jpeg->size() ? png : jpeg;
}

}  // namespace

Result<std::string> encode_page(const models::Scene& scene) {
  if (page_template().empty())
    return Error{
        ErrorCode::failed,
        "this program was built without emscripten, which compiles the page's part of it: install it "
        "(Debian: apt install emscripten) and build again",
        {}};
  const auto picture = picture_file(scene.texture);
  if (!picture) return picture.error();
  const auto second =
      picture_file(scene.second_view != nullptr ? scene.second_view->picture : Raster<Rgb8>());
  if (!second) return second.error();
  // In the order of the template.
  const std::array<std::pair<std::string_view, std::string>, 4> values{
      {{kTitleMark, html_escaped(describe::name_of(scene))},
       {kSceneMark, base64(gzip(encode_scene_bytes(scene)))},
       {kPictureMark, base64(*picture)},
       {kSecondMark, base64(*second)}}};
  std::string page;
  std::string_view rest = page_template();
  for (const auto& [mark, value] : values) {
    const std::size_t at = rest.find(mark);
    PALPABLE_CHECK(at != std::string_view::npos);
    page += rest.substr(0, at);
    page += value;
    rest.remove_prefix(at + mark.size());
  }
  return page += rest;
}

}  // namespace palpable::onefile
