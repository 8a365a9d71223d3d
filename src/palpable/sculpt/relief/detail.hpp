// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sculpt/relief/detail_options.hpp"

#include <array>
#include <optional>
#include <string_view>

namespace palpable::sculpt {

/// How a large range of depth is mapped to a relief of small height (docs/relief.md shows all operators).
/// All but `relief` follow Gomez 2012, chapter 9, with additive base and detail instead of ratios, which
/// depth does not have.
enum class DetailOperator {
  /// Our own: compresses slopes instead of heights, limits silhouettes, and preserves the order of layers
  /// and the slope limit.
  relief,
  linear,
  logarithm,
  cube_root,
  /// Y / (Y + 1), Y in units of the mean.
  normal,
  /// Subtracts a share of the local mean (Chiu et al. 1993).
  chiu,
  /// Compresses local means, in windows that are small where the depth varies, and adds the rest (Ashikhmin
  /// 2002).
  ashikhmin,
  /// An edge-preserving base is compressed by a curve, detail added (Durand & Dorsey 2002).
  bilateral,
  /// Histogram equalisation: each height gets a range proportional to its number of pixels.
  histogram
};

inline constexpr std::array kDetailOperators{
    DetailOperator::relief,    DetailOperator::linear,    DetailOperator::logarithm,
    DetailOperator::cube_root, DetailOperator::normal,    DetailOperator::chiu,
    DetailOperator::ashikhmin, DetailOperator::bilateral, DetailOperator::histogram};

/// The name on the command line ("cube-root"); and back, nullopt for an unknown name.
std::string_view name_of(DetailOperator detail);
std::optional<DetailOperator> detail_operator_from(std::string_view name);

/// The wanted result of an operator.
struct DetailTarget {
  double pixel_m = 0.001;
  /// Of the finished relief, from its lowest to its highest place.
  double height_m = 0.015;
  double steepest_slope = 3.0;
  /// Height of the scene in its own proportions over that of the relief: operators with base and detail
  /// compress by this. > 1; 10 is usual for a table-top scene on a palm-sized relief.
  double compression = 10.0;
};

/// Heights in metres, 0 ... target.height_m, before the slope limit (only `relief` obeys it by itself).
/// `nearness`: 0 (far) ... 1 (near), finite, at least 2 x 2. Long work for `relief`, `ashikhmin` and
/// `bilateral`. Errors: usage for options out of range, interrupted.
Result<Raster<float>> map_detail(const Raster<float>& nearness, DetailOperator detail,
                                 const DetailTarget& target, const DetailOptions& options, const Work& work);

/// `relief` alone (detail_relief.cpp); as map_detail().
Result<Raster<float>> gradient_domain_relief(const Raster<float>& nearness, const DetailTarget& target,
                                             const GradientDomainOptions& options, const Work& work);

}  // namespace palpable::sculpt
