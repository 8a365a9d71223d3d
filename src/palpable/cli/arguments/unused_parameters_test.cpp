// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/unused_parameters.hpp"

#include "palpable/cli/arguments/parameter_groups.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace palpable::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// `--set` with the first parameter of every step.
MakeArguments one_of_each_step() {
  MakeArguments arguments;
  SettableOptions options;
  for (const ParameterGroup& group : parameter_groups())
    arguments.stereo.parameters.push_back(parameters_of(group, options).front().name + "=1");
  return arguments;
}

TEST(UnusedParameters, KnowTheUseOfEveryStep) {
  const MakeArguments arguments = one_of_each_step();
  // A grid that was made before: no step is used.
  const auto unused = unused_parameters(arguments, {}, sources::InputKind::scene, "grid");
  EXPECT_EQ(unused.of_other_scenes.size(), parameter_groups().size()) << "a step without a row in kSteps?";
  EXPECT_THAT(unused.sentences, IsEmpty());
}

TEST(UnusedParameters, OfASolidAreThoseOfPicturesAndOtherCommands) {
  MakeArguments arguments;
  arguments.stereo.parameters = {"field.resolution=64", "field.walls.least_cells=2",
                                 "detail.chiu.mean_scale=0.1", "sheet.thickness_m=0.001",
                                 "verdict.coverage=1"};
  const auto unused = unused_parameters(arguments, {}, sources::InputKind::mesh, "field");
  EXPECT_THAT(unused.of_other_scenes,
              ElementsAre("detail.chiu.mean_scale", "sheet.thickness_m", "verdict.coverage"));
}

TEST(UnusedParameters, OfAStereoMethodAreUsedForPairsOnly) {
  MakeArguments arguments;
  // `background` is also the name of a step.
  arguments.stereo.parameters = {"background.behind_px=2", "background.least_share=0.1"};
  const auto of_pair = unused_parameters(arguments, {}, sources::InputKind::stereo, "relief");
  EXPECT_THAT(of_pair.of_other_scenes, IsEmpty());
  EXPECT_THAT(of_pair.sentences,
              ElementsAre("background.least_share has no effect without --background remove."));
  const auto of_depth = unused_parameters(arguments, {}, sources::InputKind::depth, "relief");
  EXPECT_THAT(of_depth.of_other_scenes, ElementsAre("background.behind_px"));
}

}  // namespace
}  // namespace palpable::cli
