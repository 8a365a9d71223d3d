// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/shelf/scene_card.hpp"

#include "palpable/core/vec3.hpp"
#include "palpable/describe/scene_words.hpp"
#include "palpable/page/page_scene.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::page::shelf {
namespace {

constexpr std::size_t kLongestCardText = 240;

std::string kind_words(const models::Scene& scene) {
  if (scene.map != nullptr) return std::string(kMapKind);
  const std::string kind = models::kind_of(scene.model);
  if (kind == "contours") return "a drawing's lines";
  if (kind == "relief") return "a relief";
  if (kind == "grid") return std::string(kGridKind);
  return "a solid";
}

/// Whole sentences while there is room; of a first one that is longer, whole words.
std::string first_sentences(const std::string& text) {
  if (text.size() <= kLongestCardText) return text;
  const auto end = text.rfind(". ", kLongestCardText);
  if (end != std::string::npos) return text.substr(0, end + 1);
  const auto blank = text.rfind(' ', kLongestCardText);
  return text.substr(0, blank == std::string::npos ? 0 : blank) + " …";
}

// Of a relief without a picture.
constexpr Rgb8 kClay{201, 184, 163};

std::uint8_t shaded(std::uint8_t value, double light) {
  return static_cast<std::uint8_t>(std::clamp(value * light, 0.0, 255.0));
}

}  // namespace

SceneCard scene_card(const models::Scene& scene) {
  SceneCard card{describe::name_of(scene), kind_words(scene), {}};
  if (!scene.description.empty()) {
    card.sentence = first_sentences(scene.description);
  } else if (const auto parts = describe::scene_parts(scene, 1.0, {}); !parts.empty()) {
    // It begins with the name, which is the title here.
    std::string words = parts.front();
    const auto end = words.find(". ");
    if (words.starts_with(card.title) && end != std::string::npos && end <= card.title.size() + 1)
      words.erase(0, end + 2);
    card.sentence = first_sentences(words);
  }
  return card;
}

Raster<Rgb8> scene_picture(const models::Scene& scene, int longest_side) {
  const auto page = page_scene(scene, 0, {});
  const auto& heights = page->height_m;
  const double aspect = page->about.size_y_m / page->about.size_x_m;
  const auto side = [&](double share) {
    return std::max(2, static_cast<int>(std::lround(share * longest_side)));
  };
  Raster<Rgb8> picture(side(std::min(1.0, 1.0 / aspect)), side(std::min(1.0, aspect)));
  const double pixel_m = page->about.size_x_m / picture.width();
  const auto height_at = [&](int x, int y) {
    const int i = std::clamp((2 * x + 1) * heights.width() / (2 * picture.width()), 0, heights.width() - 1);
    const int j =
        std::clamp((2 * y + 1) * heights.height() / (2 * picture.height()), 0, heights.height() - 1);
    return static_cast<double>(heights(i, j));
  };
  const auto colour_at = [&](int x, int y) {
    if (page->picture.empty()) return kClay;
    const auto& from = page->picture;
    return from(std::min((2 * x + 1) * from.width() / (2 * picture.width()), from.width() - 1),
                std::min((2 * y + 1) * from.height() / (2 * picture.height()), from.height() - 1));
  };
  const Vec3 light = unit(Vec3{-1.0, 1.0, 1.6});
  // A level surface keeps its colours.
  const double level = light.z;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const double slope_x = (height_at(x + 1, y) - height_at(x - 1, y)) / (2.0 * pixel_m);
      const double slope_y = (height_at(x, y - 1) - height_at(x, y + 1)) / (2.0 * pixel_m);
      const double lit = std::max(0.0, dot(unit(Vec3{-slope_x, -slope_y, 1.0}), light));
      const double share = 0.35 + 0.65 * lit / level;
      const Rgb8 colour = colour_at(x, y);
      picture(x, y) = {shaded(colour.r, share), shaded(colour.g, share), shaded(colour.b, share)};
    }
  }
  return picture;
}

}  // namespace palpable::page::shelf
