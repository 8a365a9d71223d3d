// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/law.hpp"

#include <string_view>

namespace palpable::haptics {

// The parameters of laws as options of the command line, which other programs offer too.

/// How many of an option's unit are one of the parameter's: lengths are given in mm, other values in SI.
double typed_per_si(const LawParameter& parameter);

/// Sets the parameter of `law` that has this option to a value in the option's unit; false if the law has
/// none.
bool set_by_option(LawParameters& parameters, const LawDescription& law, std::string_view option,
                   double typed);

/// Whether it is a contact law without a ball.
bool touches_with_a_point(const LawDescription& law);

}  // namespace palpable::haptics
