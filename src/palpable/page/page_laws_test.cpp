// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/page_laws.hpp"

#include <algorithm>
#include <bit>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::page {
namespace {

/// A level solid as a field.
models::Scene level_solid() {
  const auto word = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  models::FieldTree tree;
  tree.words = {0U, word(0), word(0), word(1), word(-0.003F)};
  tree.roots = {models::FieldTree::kLeaf};
  auto distance = models::DistanceField::from_tree({{-0.004, -0.004, 0.0}, 0.001, 3, {1, 1, 1}}, tree,
                                                   {1e-5, 2e-5, 3e-5});
  models::Scene scene;
  scene.model = std::make_shared<const models::Field>(
      *models::field_of(*std::move(distance), {-0.0039, -0.0039, 0.0}, {0.0039, 0.0039, 0.003}));
  return scene;
}

std::optional<protocol::Law> law_named(const protocol::Laws& laws, const std::string& name) {
  const auto found =
      std::find_if(laws.laws.begin(), laws.laws.end(), [&](const auto& law) { return law.name == name; });
  return found == laws.laws.end() ? std::nullopt : std::optional(*found);
}

TEST(PageLaws, OfferTheToolToDevicesWithTorqueAndSayWhyNotToOthers) {
  device::Traits device;
  device.has_torque = true;
  const auto offered = law_named(page_laws(level_solid(), device), "tool");
  ASSERT_TRUE(offered);
  EXPECT_FALSE(offered->unavailable);
  EXPECT_FALSE(offered->parameters.empty());
  device.has_torque = false;
  const auto refused = law_named(page_laws(level_solid(), device), "tool");
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->unavailable, "needs a device with torque");
}

TEST(PageLaws, ShowTheBoundsOfTracingAsASwitch) {
  const auto& parameters = haptics::description_of(haptics::Law::tracing).parameters;
  const auto bounds = std::find_if(parameters.begin(), parameters.end(),
                                   [](const auto& p) { return p.name == "tracing_bounds"; });
  ASSERT_NE(bounds, parameters.end());
  // As the page asks (web/src/settings/parameter_panel.ts).
  EXPECT_EQ(bounds->unit, "yes or no");
  EXPECT_EQ(bounds->slider_min, 0.0);
  EXPECT_EQ(bounds->slider_max, 1.0);
}

TEST(PageLaws, ListEveryLawOfTheSceneWithEveryParameterOfItsDescription) {
  const models::Scene scene = level_solid();
  const auto laws = page_laws(scene, {});
  const auto known = haptics::laws_for(scene);
  ASSERT_EQ(laws.laws.size(), known.size());
  for (std::size_t k = 0; k < known.size(); ++k) {
    const auto& description = haptics::description_of(known[k]);
    EXPECT_EQ(laws.laws[k].name, description.name);
    ASSERT_EQ(laws.laws[k].parameters.size(), description.parameters.size()) << description.name;
    for (std::size_t p = 0; p < description.parameters.size(); ++p) {
      EXPECT_EQ(laws.laws[k].parameters[p].title, description.parameters[p].title);
      EXPECT_LT(laws.laws[k].parameters[p].min, laws.laws[k].parameters[p].max);
    }
  }
}

}  // namespace
}  // namespace palpable::page
