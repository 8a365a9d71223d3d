// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/scene.hpp"

namespace palpable::models {
namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};

}  // namespace

std::string kind_of(const Model& model) {
  return std::visit(Overloaded{[](const std::shared_ptr<const Relief>&) { return std::string("relief"); }},
                    model);
}

Vec3 size_m(const Scene& scene) {
  return std::visit(Overloaded{[](const std::shared_ptr<const Relief>& relief) {
                      return Vec3{relief->width_m(), relief->depth_m(), relief->highest_m()};
                    }},
                    scene.model);
}

}  // namespace palpable::models
