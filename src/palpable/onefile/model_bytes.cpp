// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/onefile/model_bytes.hpp"

#include "palpable/core/picture/image.hpp"
#include "palpable/formats/packing/float_planes.hpp"
#include "palpable/formats/scene/field_streams.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace palpable::onefile {

template <class Archive>
void fields(Archive& archive, typename Archive::template Ref<models::FieldErrors> errors) {
  archive(errors.bound_m, errors.p99_m, errors.max_m);
}

template <class Archive>
void fields(Archive& archive, typename Archive::template Ref<models::Superquadric> shape) {
  archive(shape.size_m, shape.e1, shape.e2, shape.taper_x, shape.taper_y, shape.bend_per_m,
          shape.bend_angle_rad, shape.scene_from_shape.rotation, shape.scene_from_shape.translation_m);
}

namespace {

using models::Model;

Error damaged() { return invalid_input("holds a model that is damaged or cut off"); }

void write_floats(ByteOutput& out, std::span<const float> values, int row) {
  out.block(formats::planes_of(values, static_cast<std::size_t>(row)));
}

/// Exactly `count` floats; nullopt for another number.
std::optional<std::vector<float>> read_floats(ByteInput& in, std::size_t count, int row) {
  const auto planes = in.block();
  if (!in.ok() || planes.size() % 4 != 0 || planes.size() / 4 != count) return std::nullopt;
  return formats::floats_of(planes, static_cast<std::size_t>(row));
}

/// The sides of a raster; nullopt if it has none, or more pixels than are read.
std::optional<std::size_t> read_sides(ByteInput& in, int& width, int& height) {
  in(width, height);
  if (!in.ok() || !check_picture_size(width, height)) return std::nullopt;
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

void write(ByteOutput& out, const models::Relief& relief) {
  const Raster<float>& heights = relief.samples_m();
  out(heights.width(), heights.height(), relief.pixel_m());
  write_floats(out, heights.values(), heights.width());
}

Result<std::shared_ptr<const models::Relief>> read_relief(ByteInput& in) {
  int width = 0, height = 0;
  double pixel_m = 0.0;
  const auto count = read_sides(in, width, height);
  in(pixel_m);
  if (!count) return damaged();
  auto values = read_floats(in, *count, width);
  if (!values) return damaged();
  auto relief = models::Relief::from_samples({width, height, std::move(*values)}, pixel_m);
  if (!relief) return relief.error();
  return std::make_shared<const models::Relief>(*std::move(relief));
}

void write(ByteOutput& out, const models::Contours& contours) {
  const models::BoundaryMap& map = contours.boundaries;
  const auto edges = map.edges().values();
  // Plane by plane, since neighbours in a plane are similar.
  std::vector<float> planes(2 * edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    planes[i] = edges[i].c2;
    planes[i + edges.size()] = edges[i].s2;
  }
  out(map.edges().width(), map.edges().height(), map.pixel_m(), map.radius_px(), map.origin().threshold,
      map.origin().boundary_fraction);
  write_floats(out, planes, map.edges().width());
  write(out, *contours.grooves);
}

Result<Model> read_contours(ByteInput& in) {
  int width = 0, height = 0;
  double pixel_m = 0.0, radius_px = 0.0;
  models::BoundaryOrigin origin;
  const auto count = read_sides(in, width, height);
  in(pixel_m, radius_px, origin.threshold, origin.boundary_fraction);
  if (!count) return damaged();
  const auto planes = read_floats(in, 2 * *count, width);
  if (!planes) return damaged();
  Raster<models::BoundaryPixel> edges(width, height);
  for (std::size_t i = 0; i < *count; ++i) edges.values()[i] = {(*planes)[i], (*planes)[i + *count]};
  auto map = models::BoundaryMap::from_edges(std::move(edges), pixel_m, radius_px, origin, Work{});
  if (!map) return map.error();
  auto grooves = read_relief(in);
  if (!grooves) return grooves.error();
  return Model(
      std::make_shared<const models::Contours>(models::Contours{*std::move(map), *std::move(grooves)}));
}

void write(ByteOutput& out, const models::Grid& grid) {
  const models::Occupancy o = grid.occupancy.occupancy();
  // Eight points per byte, x fastest, lowest bit first.
  std::vector<std::byte> bits((o.points() + 7) / 8);
  for (std::size_t i = 0; i < o.points(); ++i)
    bits[i / 8] |= static_cast<std::byte>(o.occupied[i] << (i % 8));
  out(o.counts, o.origin_m, o.spacing_m);
  out.block(bits);
  write(out, *grid.from_above);
}

Result<Model> read_grid(ByteInput& in) {
  models::Occupancy o;
  in(o.counts, o.origin_m, o.spacing_m);
  double points = 1.0;
  for (const int count : o.counts) points *= std::max(0, count);
  const auto bits = in.block();
  if (!in.ok() || points > static_cast<double>(models::kMaxGridPoints)) return damaged();
  const auto count = static_cast<std::size_t>(points);
  if (bits.size() != (count + 7) / 8) return damaged();
  o.occupied.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    o.occupied[i] = static_cast<std::uint8_t>(std::to_integer<unsigned>(bits[i / 8]) >> (i % 8) & 1U);
  auto occupancy = models::OccupancyGrid::from(o, Work{});
  if (!occupancy) return occupancy.error();
  auto from_above = read_relief(in);
  if (!from_above) return from_above.error();
  return Model(
      std::make_shared<const models::Grid>(models::Grid{*std::move(occupancy), *std::move(from_above)}));
}

template <class Distance>
void write_solid(ByteOutput& out, const models::SolidField<Distance>& field) {
  out(field.distance.errors(), field.least_m, field.most_m, field.primitives);
}

/// The model from its distance field, which `make` makes with the measured errors.
template <class Make>
Result<Model> read_solid(ByteInput& in, const Make& make) {
  models::FieldErrors errors;
  Vec3 least_m, most_m;
  std::vector<models::Superquadric> primitives;
  in(errors, least_m, most_m, primitives);
  if (!in.ok()) return damaged();
  for (const models::Superquadric& shape : primitives)
    if (auto valid = models::check_superquadric(shape); !valid) return valid.error();
  auto distance = make(errors);
  if (!distance) return distance.error();
  auto field = models::field_of(*std::move(distance), least_m, most_m);
  if (!field) return field.error();
  field->primitives = std::move(primitives);
  using Solid = std::decay_t<decltype(*field)>;
  return Model(std::make_shared<const Solid>(*std::move(field)));
}

void write(ByteOutput& out, const models::Field& field) {
  const models::FieldGrid& grid = field.distance.grid();
  out(grid.origin_m, grid.cell_m, grid.levels, grid.roots);
  for (const auto& stream : formats::streams_of(grid, field.distance.tree()).bytes)
    out.block(std::as_bytes(std::span(stream)));
  write_solid(out, field);
}

/// Whether the tree's decoder can work on it; DistanceField checks the rest.
bool is_readable(const models::FieldGrid& grid) {
  constexpr int kMostLevels = 10, kMostRoots = 1 << 20;
  return grid.levels >= 0 && grid.levels <= kMostLevels &&
         std::all_of(grid.roots.begin(), grid.roots.end(),
                     [](int roots) { return roots >= 1 && roots <= kMostRoots; });
}

Result<Model> read_field(ByteInput& in) {
  models::FieldGrid grid;
  in(grid.origin_m, grid.cell_m, grid.levels, grid.roots);
  formats::FieldStreams streams;
  for (auto& stream : streams.bytes) {
    const auto bytes = as_text(in.block());
    stream.assign(bytes.begin(), bytes.end());
  }
  if (!in.ok() || !is_readable(grid)) return damaged();
  auto tree = formats::tree_from(grid, streams);
  if (!tree) return tree.error();
  return read_solid(in, [&](const models::FieldErrors& errors) {
    return models::DistanceField::from_tree(grid, *std::move(tree), errors);
  });
}

void write(ByteOutput& out, const models::FieldOnLattice& field) {
  const models::Lattice& lattice = field.distance.lattice();
  out(lattice.origin_m, lattice.spacing_m, lattice.counts);
  out.choice(field.distance.content(), 2);
  write_floats(out, field.distance.values(), lattice.counts[0]);
  write_solid(out, field);
}

Result<Model> read_dense_field(ByteInput& in) {
  models::Lattice lattice;
  auto content = models::DenseContent::distance;
  in(lattice.origin_m, lattice.spacing_m, lattice.counts);
  in.choice(content, 2);
  const auto planes = in.block();
  double bytes = 4.0 * static_cast<double>(models::floats_of(content));
  for (const int count : lattice.counts) bytes *= std::max(0, count);
  if (!in.ok() || bytes <= 0.0 || bytes != static_cast<double>(planes.size())) return damaged();
  auto values = formats::floats_of(planes, static_cast<std::size_t>(lattice.counts[0]));
  return read_solid(in, [&](const models::FieldErrors& errors) {
    return models::DenseField::from(lattice, content, std::move(values), errors);
  });
}

using Reader = Result<Model> (*)(ByteInput& in);
/// In the order of models::Model.
constexpr std::array<Reader, std::variant_size_v<Model>> kReaders{[](ByteInput& in) -> Result<Model> {
                                                                    auto relief = read_relief(in);
                                                                    if (!relief) return relief.error();
                                                                    return Model(*std::move(relief));
                                                                  },
                                                                  read_contours, read_field, read_grid,
                                                                  read_dense_field};

}  // namespace

void write_model(ByteOutput& out, const models::Model& model) {
  out.choice(model.index(), static_cast<unsigned>(kReaders.size()));
  std::visit([&](const auto& shared) { write(out, *shared); }, model);
}

Result<models::Model> read_model(ByteInput& in) {
  std::size_t kind = 0;
  in.choice(kind, static_cast<unsigned>(kReaders.size()));
  if (!in.ok()) return damaged();
  return kReaders.at(kind)(in);
}

}  // namespace palpable::onefile
