// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/make_options.hpp"
#include "palpable/haptics/law/laws.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace palpable::cli {

/// What one of the five papers set together, as far as this program holds it. None of them states a
/// stiffness or a damping in a unit: those stay the scene's.
struct Published {
  std::string_view name;
  haptics::Law law;
  /// Of the law penalty: LawParameters::force_shading.
  double force_shading = 0.0;
  /// Of the servo; not given where the paper states none.
  std::optional<double> rate_hz;
  /// How it made its scene: a stereo method or a contour method, empty where it had no other than ours.
  std::string_view stereo_method;
  std::string_view contour_method;
  /// The area that the picture was mapped to, WxHxD in mm (the depth is ours); empty where none is stated.
  std::string_view size;
  /// How depths got another number of samples.
  std::string_view resampling;
  /// What of the paper is not the same here, one sentence.
  std::string_view differs;
  /// What the scene became.
  session::MakeAs as = session::MakeAs::by_input;
  /// A field's distance and force stored at every place of a lattice.
  bool keeps_forces = false;
};

/// Adds --as-published. `name` must outlive the parsing.
void add_as_published(Options& options, std::string& name);

/// The paper's settings; nothing for an empty name. Errors: usage, for another name.
Result<std::optional<Published>> published_as(const std::string& name);

/// Sets how the scene is made where `arguments` leave it open.
void apply_published(const Published& published, MakeArguments& arguments);

}  // namespace palpable::cli
