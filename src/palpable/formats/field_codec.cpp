// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/byte_reader.hpp"
#include "palpable/formats/byte_block.hpp"
#include "palpable/formats/model_codec.hpp"
#include "palpable/models/field_leaf.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace palpable::formats {
namespace {

// A field's member: four streams, each packed by zstd for itself. The tree in depth-first order, an entry a
// byte (0 a node, 1 a leaf); for each leaf which words it holds, as the distance back to the last leaf that
// held them, or 0 for new ones; the new leaves' heads; and all their other words, byte by byte in four
// planes. No number leads anywhere by itself, so a damaged file cannot build a tree that is not one.

using models::FieldGrid;
using models::FieldTree;
using models::LeafHead;

constexpr const char* kCells = "cells.field.zst";
constexpr std::size_t kMostBytes = std::size_t{1} << 31U;

Error damaged() { return invalid_input("holds a field that is damaged or cut off"); }

/// Seven bits a byte, the last one without its high bit.
void put_count(std::vector<std::uint8_t>& out, std::uint32_t value) {
  for (; value >= 0x80U; value >>= 7U) out.push_back(static_cast<std::uint8_t>(value | 0x80U));
  out.push_back(static_cast<std::uint8_t>(value));
}
std::optional<std::uint32_t> take_count(std::span<const std::uint8_t> in, std::size_t& at) {
  std::uint32_t value = 0;
  for (unsigned shift = 0; shift < 35 && at < in.size(); shift += 7) {
    const std::uint8_t byte = in[at++];
    value |= static_cast<std::uint32_t>(byte & 0x7FU) << shift;
    if ((byte & 0x80U) == 0) return value;
  }
  return std::nullopt;
}

struct Streams {
  std::vector<std::uint8_t> tree, shared, heads;
  std::vector<std::uint32_t> words;
};

class Writer {
 public:
  explicit Writer(const FieldTree& tree)
      : tree_(tree), last_(tree.words.size(), std::numeric_limits<std::uint32_t>::max()) {}

  Streams write() {
    for (const std::uint32_t entry : tree_.roots) add(entry);
    return std::move(out_);
  }

 private:
  void add(std::uint32_t entry) {
    const bool leaf = (entry & FieldTree::kLeaf) != 0;
    out_.tree.push_back(leaf ? 1 : 0);
    if (!leaf) {
      for (std::size_t i = 0; i < 8; ++i) add(tree_.nodes[8 * std::size_t{entry} + i]);
      return;
    }
    const std::uint32_t at = entry & ~FieldTree::kLeaf;
    const bool known = last_[at] != std::numeric_limits<std::uint32_t>::max();
    put_count(out_.shared, known ? leaves_ - last_[at] : 0);
    last_[at] = leaves_++;
    if (known) return;
    const LeafHead head{tree_.words[at]};
    out_.heads.push_back(static_cast<std::uint8_t>(head.bits));
    out_.words.insert(out_.words.end(), tree_.words.begin() + at + 1,
                      tree_.words.begin() + at + static_cast<std::ptrdiff_t>(head.words()));
  }

  const FieldTree& tree_;
  Streams out_;
  std::vector<std::uint32_t> last_;
  std::uint32_t leaves_ = 0;
};

class Reader {
 public:
  Reader(const Streams& in, int levels) : in_(in), levels_(levels) {}

  Result<FieldTree> read(std::size_t roots) {
    tree_.roots.reserve(std::min(roots, in_.tree.size()));
    for (std::size_t i = 0; i < roots && ok_; ++i) {
      const std::uint32_t entry = add(levels_);
      tree_.roots.push_back(entry);
    }
    if (!ok_ || tree_at_ != in_.tree.size() || word_at_ != in_.words.size()) return damaged();
    return std::move(tree_);
  }

 private:
  std::uint32_t fail() {
    ok_ = false;
    return FieldTree::kLeaf;
  }

  std::uint32_t add(int level) {
    if (!ok_ || tree_at_ >= in_.tree.size()) return fail();
    if (in_.tree[tree_at_++] != 0) return add_leaf();
    if (level < 1) return fail();
    const std::size_t node = tree_.nodes.size() / 8;
    tree_.nodes.resize(tree_.nodes.size() + 8);
    for (std::size_t i = 0; i < 8; ++i) {
      const std::uint32_t entry = add(level - 1);
      tree_.nodes[8 * node + i] = entry;
    }
    return static_cast<std::uint32_t>(node);
  }

  std::uint32_t add_leaf() {
    const auto back = take_count(in_.shared, shared_at_);
    if (!back || *back > leaves_.size()) return fail();
    std::uint32_t begin = static_cast<std::uint32_t>(tree_.words.size());
    if (*back > 0) {
      begin = leaves_[leaves_.size() - *back];
    } else {
      if (head_at_ >= in_.heads.size()) return fail();
      const LeafHead head{in_.heads[head_at_++]};
      if (head.pieces() > 3 || head.words() - 1 > in_.words.size() - word_at_) return fail();
      tree_.words.push_back(head.bits);
      const auto first = in_.words.begin() + static_cast<std::ptrdiff_t>(word_at_);
      tree_.words.insert(tree_.words.end(), first, first + static_cast<std::ptrdiff_t>(head.words()) - 1);
      word_at_ += head.words() - 1;
    }
    leaves_.push_back(begin);
    return begin | FieldTree::kLeaf;
  }

  const Streams& in_;
  int levels_;
  FieldTree tree_;
  std::vector<std::uint32_t> leaves_;
  std::size_t tree_at_ = 0, shared_at_ = 0, head_at_ = 0, word_at_ = 0;
  bool ok_ = true;
};

std::vector<std::uint8_t> planes_of(std::span<const std::uint32_t> words) {
  std::vector<std::uint8_t> planes(4 * words.size());
  for (std::size_t plane = 0; plane < 4; ++plane)
    for (std::size_t i = 0; i < words.size(); ++i)
      planes[plane * words.size() + i] = static_cast<std::uint8_t>(words[i] >> (8 * plane));
  return planes;
}

std::vector<std::uint32_t> words_of(std::span<const std::uint8_t> planes) {
  std::vector<std::uint32_t> words(planes.size() / 4);
  for (std::size_t plane = 0; plane < 4; ++plane)
    for (std::size_t i = 0; i < words.size(); ++i)
      words[i] |= static_cast<std::uint32_t>(planes[plane * words.size() + i]) << (8 * plane);
  return words;
}

nlohmann::json json_of(Vec3 v) { return {v.x, v.y, v.z}; }
Vec3 vec3_from(const nlohmann::json& j) {
  const auto v = j.get<std::array<double, 3>>();
  return {v[0], v[1], v[2]};
}

}  // namespace

Result<void> write_field(const models::Field& field, nlohmann::json& description, ZipMembers& members) {
  const Streams streams = Writer(field.distance.tree()).write();
  const FieldGrid& grid = field.distance.grid();
  description = {{"origin_m", json_of(grid.origin_m)},
                 {"cell_m", grid.cell_m},
                 {"levels", grid.levels},
                 {"roots", grid.roots},
                 {"least_m", json_of(field.least_m)},
                 {"most_m", json_of(field.most_m)},
                 {"error_bound_m", field.distance.errors().bound_m},
                 {"error_p99_m", field.distance.errors().p99_m},
                 {"error_max_m", field.distance.errors().max_m},
                 {"cells", kCells}};
  Bytes member;
  const std::vector<std::uint8_t> planes = planes_of(streams.words);
  const std::array<std::span<const std::uint8_t>, 4> parts{streams.tree, streams.shared, streams.heads,
                                                           planes};
  nlohmann::json sizes = nlohmann::json::array();
  for (const auto part : parts) {
    const auto bytes = pack_bytes(part);
    if (!bytes) return bytes.error();
    sizes.push_back(bytes->size());
    member.insert(member.end(), bytes->begin(), bytes->end());
  }
  description["parts"] = sizes;
  members[kCells] = std::move(member);
  return {};
}

Result<models::Model> read_field(const nlohmann::json& description, const ZipMembers& members) {
  const auto member = members.find(description.at("cells").get<std::string>());
  if (member == members.end()) return invalid_input("lacks the cells of its field");
  FieldGrid grid;
  grid.origin_m = vec3_from(description.at("origin_m"));
  grid.cell_m = description.at("cell_m").get<double>();
  grid.levels = description.at("levels").get<int>();
  grid.roots = description.at("roots").get<std::array<int, 3>>();
  const auto sizes = description.at("parts").get<std::array<std::size_t, 4>>();
  std::array<std::vector<std::uint8_t>, 4> parts;
  std::span<const std::byte> left(member->second);
  for (std::size_t i = 0; i < 4; ++i) {
    if (sizes[i] > left.size()) return damaged();
    auto bytes = unpack_bytes(left.first(sizes[i]), kMostBytes);
    if (!bytes) return bytes.error();
    parts[i] = std::move(*bytes);
    left = left.subspan(sizes[i]);
  }
  if (grid.levels < 0 || grid.levels > 10 || parts[3].size() % 4 != 0) return damaged();
  std::size_t roots = 1;
  for (const int n : grid.roots) {
    if (n < 1 || n > (1 << 20)) return damaged();
    roots = std::min(roots * static_cast<std::size_t>(n), kMostBytes);
  }
  const Streams streams{std::move(parts[0]), std::move(parts[1]), std::move(parts[2]), words_of(parts[3])};
  auto tree = Reader(streams, grid.levels).read(roots);
  if (!tree) return tree.error();
  models::FieldErrors errors{description.at("error_bound_m").get<double>(),
                             description.at("error_p99_m").get<double>(),
                             description.at("error_max_m").get<double>()};
  auto distance = models::DistanceField::from_tree(grid, std::move(*tree), errors);
  if (!distance) return distance.error();
  auto field = models::field_of(std::move(*distance), vec3_from(description.at("least_m")),
                                vec3_from(description.at("most_m")));
  if (!field) return field.error();
  return models::Model(std::make_shared<const models::Field>(std::move(*field)));
}

}  // namespace palpable::formats
