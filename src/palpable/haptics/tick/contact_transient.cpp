// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/contact_transient.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace palpable::haptics {
namespace {

struct KnownTransient {
  TransientKind kind;
  std::string_view name;
  ContactTransient transient;
};
constexpr std::array<KnownTransient, 4> kKnownTransients{
    {{TransientKind::none, "none", {}},
     {TransientKind::rubber, "rubber", {2.0, 18.0, 60.0}},
     {TransientKind::wood, "wood", {4.0, 100.0, 80.0}},
     {TransientKind::metal, "metal", {4.0, 300.0, 90.0}}}};

const KnownTransient& known(TransientKind kind) { return kKnownTransients[static_cast<std::size_t>(kind)]; }

}  // namespace

std::string_view name_of(TransientKind kind) { return known(kind).name; }

std::optional<TransientKind> transient_kind_from(std::string_view name) {
  const auto* found = std::find_if(kKnownTransients.begin(), kKnownTransients.end(),
                                   [name](const KnownTransient& k) { return k.name == name; });
  return found != kKnownTransients.end() ? std::optional(found->kind) : std::nullopt;
}

ContactTransient transient_of(TransientKind kind) { return known(kind).transient; }

}  // namespace palpable::haptics
