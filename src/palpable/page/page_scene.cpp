// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/page_scene.hpp"

#include "palpable/describe/found_places.hpp"
#include "palpable/describe/scene_words.hpp"
#include "palpable/page/page_materials.hpp"
#include "palpable/page/surface_cells.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace palpable::page {
namespace {

constexpr int kLongestSide = 640;

// Evaluates the touched surface at the page's points; the relief's samples are only its control values.
Raster<float> sampled(const models::Relief& relief) {
  const int longest = std::max(relief.samples_m().width(), relief.samples_m().height());
  const double shrink = std::min(1.0, static_cast<double>(kLongestSide) / longest);
  const auto side = [&](int n) { return std::max(2, static_cast<int>(n * shrink + 0.5)); };
  Raster<float> heights(side(relief.samples_m().width()), side(relief.samples_m().height()));
  for (int j = 0; j < heights.height(); ++j) {
    const double y_m = (0.5 - (j + 0.5) / heights.height()) * relief.size_y_m();
    for (int i = 0; i < heights.width(); ++i) {
      const double x_m = ((i + 0.5) / heights.width() - 0.5) * relief.size_x_m();
      heights(i, j) = static_cast<float>(relief.sample(x_m, y_m).z_m);
    }
  }
  return heights;
}

}  // namespace

std::shared_ptr<const PageScene> page_scene(const models::Scene& scene, std::uint32_t number,
                                            const std::string& name) {
  auto page = std::make_shared<PageScene>();
  const Vec3 size = models::size_m(scene);
  page->height_m = sampled(*models::relief_of(scene));
  const auto [lowest, highest] =
      std::minmax_element(page->height_m.values().begin(), page->height_m.values().end());
  page->picture = scene.texture;
  page->second_view = scene.second_view;
  auto& about = page->about;
  about.scene = number;
  about.name = name.empty() ? describe::name_of(scene) : name;
  if (!scene.description.empty()) about.description = scene.description;
  about.kind = models::kind_of(scene.model);
  about.upright = models::is_upright_solid(scene);
  about.size_x_m = size.x;
  about.size_y_m = size.y;
  const Vec3 middle = models::centre_m(scene);
  about.middle_x_m = middle.x;
  about.middle_y_m = middle.y;
  const Place start = describe::start_place(scene);
  about.start_x_m = start.x_m;
  about.start_y_m = start.y_m;
  about.lowest_m = static_cast<double>(*lowest);
  about.highest_m = static_cast<double>(*highest);
  about.has_picture = !scene.texture.empty();
  about.has_second_view = scene.second_view != nullptr;
  if (auto cells = surface_cells(scene)) {
    page->cells = std::move(cells->picture);
    about.cells = std::move(cells->words);
  }
  for (const auto& material : scene.materials) about.labels.push_back(own_name(material));
  return page;
}

}  // namespace palpable::page
