// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field/dense_field_from_source.hpp"

#include "palpable/sculpt/field/fast_marching.hpp"
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/field/field_too_large.hpp"
#include "palpable/sculpt/field/measured_errors.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace palpable::sculpt {
namespace {

using models::DenseContent;
using models::Lattice;

Lattice lattice_of(const Box& bounds, double spacing_m, double asked_margin_m) {
  const double margin_m = field_margin_m(bounds, asked_margin_m);
  const Vec3 size = bounds.size_m();
  const auto count = [&](double extent) {
    return static_cast<int>(std::ceil((extent + 2.0 * margin_m) / spacing_m - 1e-9)) + 1;
  };
  Lattice lattice;
  lattice.spacing_m = spacing_m;
  lattice.counts = {count(size.x), count(size.y), count(size.z)};
  lattice.origin_m = 0.5 * (bounds.least_m + bounds.most_m) - 0.5 * lattice.size_m();
  return lattice;
}

double bytes_of(const Lattice& lattice, DenseContent content) {
  double places = 1.0;
  for (const int count : lattice.counts) places *= count;
  return static_cast<double>(sizeof(float) * models::floats_of(content)) * places;
}

/// Calls each(z) for every layer of points, on all threads.
template <class Each>
Result<void> for_layers(const Lattice& lattice, std::string_view what, const Work& work, const Each& each) {
  std::atomic<int> done{0};
  parallel_for(work, lattice.counts[2], 1, [&](int begin, int end) {
    for (int z = begin; z < end && !work.cancelled(); ++z) {
      each(z);
      const int now = ++done;
      if (begin == 0) work.report(static_cast<double>(now) / lattice.counts[2], what);
    }
  });
  if (work.cancelled()) return Work::interrupted();
  return {};
}

Result<std::vector<float>> exact_distances(const DistanceSource& source, const Lattice& lattice,
                                           const Work& work) {
  std::vector<float> values(lattice.places());
  const auto done = for_layers(lattice, "asking every place's distance", work, [&](int z) {
    DistanceSource::Hint hint;
    for (int y = 0; y < lattice.counts[1]; ++y)
      for (int k = 0; k < lattice.counts[0]; ++k) {
        // In alternating directions, so that each point is near the previous one.
        const int x = y % 2 == 0 ? k : lattice.counts[0] - 1 - k;
        values[lattice.index(x, y, z)] =
            static_cast<float>(source.at(lattice.place_m(x, y, z), hint).distance_m);
      }
  });
  if (!done) return done.error();
  return values;
}

/// Computes the exact distance within a cell of the surface, from which the front starts on both sides.
Result<Front> front_of(const DistanceSource& source, const Lattice& lattice, const Work& work) {
  constexpr int kBlock = 8;
  // Slightly more than a cell: a source's distance has an error of less than a thousandth, and where faces
  // are parallel to the lattice both their sides must be known.
  constexpr double kBand = 1.01;
  Front front{lattice, std::vector<float>(4 * lattice.places()), {}};
  std::vector<std::uint8_t> known(lattice.places());
  const double block_m = 0.5 * (kBlock - 1) * std::numbers::sqrt3 * lattice.spacing_m;
  const auto ask = [&](int x, int y, int z, DistanceSource::Hint& hint) {
    const models::DistanceSample s = source.at(lattice.place_m(x, y, z), hint);
    if (!(std::abs(s.distance_m) <= kBand * lattice.spacing_m)) return;
    const std::size_t at = lattice.index(x, y, z);
    known[at] = 1;
    front.values[4 * at] = static_cast<float>(s.distance_m);
    front.values[4 * at + 1] = static_cast<float>(s.gradient.x);
    front.values[4 * at + 2] = static_cast<float>(s.gradient.y);
    front.values[4 * at + 3] = static_cast<float>(s.gradient.z);
  };
  const auto blocks = [&](std::size_t axis) { return (lattice.counts[axis] + kBlock - 1) / kBlock; };
  parallel_for(work, blocks(2), 1, [&](int begin, int end) {
    for (int k = begin; k < end && !work.cancelled(); ++k) {
      DistanceSource::Hint hint;
      if (begin == 0) work.report(static_cast<double>(k) / end, "looking for the surface");
      for (int j = 0; j < blocks(1); ++j)
        for (int i = 0; i < blocks(0); ++i) {
          const Vec3 middle = lattice.place_m(kBlock * i, kBlock * j, kBlock * k) +
                              0.5 * (kBlock - 1) * lattice.spacing_m * Vec3{1.0, 1.0, 1.0};
          if (std::abs(source.at(middle, hint).distance_m) > kBand * (block_m + lattice.spacing_m)) continue;
          for (int z = kBlock * k; z < std::min(kBlock * (k + 1), lattice.counts[2]); ++z)
            for (int y = kBlock * j; y < std::min(kBlock * (j + 1), lattice.counts[1]); ++y)
              for (int x = kBlock * i; x < std::min(kBlock * (i + 1), lattice.counts[0]); ++x)
                ask(x, y, z, hint);
        }
    }
  });
  if (work.cancelled()) return Work::interrupted();
  front.known.assign(known.begin(), known.end());
  return front;
}

Result<std::vector<float>> marched(const DistanceSource& source, const Lattice& lattice, const Work& work) {
  auto front = front_of(source, lattice, work);
  if (!front) return front.error();
  if (std::find(front->known.begin(), front->known.end(), true) == front->known.end())
    return invalid_input("is a solid without a surface");
  if (const auto done = march(*front, work); !done) return done.error();
  return std::move(front->values);
}

/// Whether a stored distance is negative: a solid between the places of the lattice is lost.
bool has_inside(const std::vector<float>& values, DenseContent content) {
  for (std::size_t i = 0; i < values.size(); i += models::floats_of(content))
    if (values[i] < 0.0F) return true;
  return false;
}

}  // namespace

Result<Lattice> lattice_around(const Box& bounds, const DenseFieldOptions& options) {
  const auto spacing_m =
      finest_cell_m(bounds, {.resolution = options.resolution, .margin_m = options.margin_m});
  if (!spacing_m) return spacing_m.error();
  const Lattice lattice = lattice_of(bounds, *spacing_m, options.margin_m);
  const double needed = bytes_of(lattice, options.content), most = static_cast<double>(options.most_bytes);
  if (needed <= most) return lattice;
  int fits = static_cast<int>(options.resolution * std::cbrt(most / needed)) + 1;
  while (fits > 16 && bytes_of(lattice_of(bounds, *spacing_m * options.resolution / fits, options.margin_m),
                               options.content) > most)
    --fits;
  return field_too_large("a dense field", needed, options.most_bytes, options.resolution, fits);
}

Result<models::DenseField> dense_field_from_source(const DistanceSource& source,
                                                   const DenseFieldOptions& options, const Work& work) {
  const Box bounds = source.bounds();
  const auto lattice = lattice_around(bounds, options);
  if (!lattice) return lattice.error();
  auto values = options.content == DenseContent::distance ? exact_distances(source, *lattice, work)
                                                          : marched(source, *lattice, work);
  if (!values) return values.error();
  if (!has_inside(*values, options.content))
    return invalid_input("has no surface as a dense field of " + std::to_string(options.resolution) +
                         " cells: no place of the lattice is inside it, so it is thinner than a cell; more "
                         "cells or an adaptive field hold it");
  auto field = models::DenseField::from(*lattice, options.content, *std::move(values), {});
  if (!field) return field.error();
  const FieldOptions near;
  const double longest_m = options.resolution * lattice->spacing_m;
  const models::FieldErrors errors = measured_errors(
      [&](Vec3 p) { return field->sample({p}).distance_m; },
      {lattice->origin_m, lattice->origin_m + lattice->size_m()}, source,
      {std::max(near.inside_m, 0.03 * longest_m), std::max(near.outside_m, 0.01 * longest_m)}, work);
  field->set_errors(errors);
  return field;
}

}  // namespace palpable::sculpt
