// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/model_growth.hpp"

#include "palpable/models/field/superquadric_mesh.hpp"

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

Mesh ball_of_growth() {
  models::Superquadric ball;
  ball.size_m = {0.02, 0.02, 0.02};
  return models::mesh_of(ball, 0.008);
}

TEST(GrowingFields, ShowsTakenStepsThatAreClearlyBetter) {
  std::vector<MadeScene> shown;
  FieldRecipe field;
  const auto observe = growing_fields({0.1, 16}, field, {0, 30, 60},
                                      [&](MadeScene state) { shown.push_back(std::move(state)); }, {});
  const Mesh ball = ball_of_growth();
  observe({ModelStep::Kind::segments, 0, 0.0120, true}, ball);
  observe({ModelStep::Kind::superquadrics, 0, 0.0100, true}, ball);
  observe({ModelStep::Kind::superquadrics, 1, 0.0095, true}, ball);
  observe({ModelStep::Kind::superquadrics, 1, 0.0050, false}, ball);
  observe({ModelStep::Kind::correction, 2, 0.0080, true}, {});
  observe({ModelStep::Kind::correction, 2, 0.0080, true}, ball);
  ASSERT_EQ(shown.size(), 2U);
  EXPECT_TRUE(models::is_field(shown[1].scene.model));
  ASSERT_EQ(shown[1].notes.size(), 1U);
  EXPECT_NE(shown[1].notes[0].sentence.find("frames up to 60: 8.0 mm"), std::string::npos)
      << shown[1].notes[0].sentence;
}

TEST(GrowingFields, CostNothingWhenNobodyTakesThem) { EXPECT_FALSE(growing_fields({}, {}, {0}, {}, {})); }

}  // namespace
}  // namespace palpable::recipes
