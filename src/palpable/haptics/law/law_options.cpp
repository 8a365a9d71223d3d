// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/law_options.hpp"

#include <algorithm>

namespace palpable::haptics {

double typed_per_si(const LawParameter& parameter) { return parameter.unit == "m" ? 1000.0 : 1.0; }

bool set_by_option(LawParameters& parameters, const LawDescription& law, std::string_view option,
                   double typed) {
  const auto found = std::find_if(law.parameters.begin(), law.parameters.end(), [&](const LawParameter& p) {
    return !option.empty() && p.option == option;
  });
  if (found == law.parameters.end()) return false;
  parameters.*found->value = typed / typed_per_si(*found);
  return true;
}

bool touches_with_a_point(const LawDescription& law) {
  return law.is_contact && find_parameter(law, &LawParameters::radius_m) == nullptr;
}

}  // namespace palpable::haptics
