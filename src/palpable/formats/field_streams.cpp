// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/field_streams.hpp"

#include "palpable/models/field_leaf.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace palpable::formats {
namespace {

using models::FieldGrid;
using models::FieldTree;
using models::LeafHead;

constexpr std::size_t kNumbers = 9;
constexpr std::size_t kRecent = 4;
/// In `predictions`, after the recent pieces' places: by nothing, and not at all.
constexpr std::uint8_t kByNothing = kRecent, kRaw = kRecent + 1;

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
/// Small numbers of either sign as small numbers.
std::uint32_t folded(std::int32_t v) {
  return static_cast<std::uint32_t>(v) << 1U ^ static_cast<std::uint32_t>(v >> 31);
}
std::int32_t unfolded(std::uint32_t v) {
  return static_cast<std::int32_t>(v >> 1U) ^ -static_cast<std::int32_t>(v & 1U);
}

/// Numbers of `size` words each, apart by number and by byte.
std::vector<std::uint8_t> planes_of(std::span<const std::uint32_t> words, std::size_t size,
                                    std::size_t bytes) {
  std::vector<std::uint8_t> planes;
  planes.reserve(words.size() * bytes);
  for (std::size_t k = 0; k < size; ++k)
    for (std::size_t byte = 0; byte < bytes; ++byte)
      for (std::size_t i = k; i < words.size(); i += size)
        planes.push_back(static_cast<std::uint8_t>(words[i] >> (8 * byte)));
  return planes;
}
std::vector<std::uint32_t> words_of(std::span<const std::uint8_t> planes, std::size_t size,
                                    std::size_t bytes) {
  const std::size_t count = planes.size() / (size * bytes);
  std::vector<std::uint32_t> words(count * size);
  std::size_t at = 0;
  for (std::size_t k = 0; k < size; ++k)
    for (std::size_t byte = 0; byte < bytes; ++byte)
      for (std::size_t i = 0; i < count; ++i)
        words[i * size + k] |= static_cast<std::uint32_t>(planes[at++]) << (8 * byte);
  return words;
}

/// Where a leaf stands: its corner in finest cells, and its level.
struct Place {
  std::array<int, 3> corner{};
  int level = 0;

  double half() const { return 0.5 * (1 << level); }
  Place child(unsigned k) const {
    const int side = 1 << (level - 1);
    return {
        {corner[0] + (k & 1U ? side : 0), corner[1] + (k & 2U ? side : 0), corner[2] + (k & 4U ? side : 0)},
        level - 1};
  }
};
Place root_place(const FieldGrid& grid, std::size_t index) {
  const auto i = static_cast<int>(index);
  return {{i % grid.roots[0] << grid.levels, i / grid.roots[0] % grid.roots[1] << grid.levels,
           i / (grid.roots[0] * grid.roots[1]) << grid.levels},
          grid.levels};
}

/// A curved piece in whole steps: its middle, and l and Q (xx, yy, zz, xy, xz, yz).
struct Curved {
  std::int32_t middle = 0;
  std::array<std::int32_t, kNumbers> numbers{};
};

/// Halves of the leaf's side in one step of the middle.
double middle_step(int level) { return 2.0 / (LeafHead::kValuesPerCell * (1 << level)); }

std::optional<Curved> steps_of(const std::uint32_t* words, int level) {
  const double middle = models::detail::f64(words[0]) / middle_step(level);
  if (!(std::abs(middle) < 1e9) || middle != std::round(middle)) return std::nullopt;
  if (words[5] >> 16U != 0 || (middle == 0.0 && words[0] != 0)) return std::nullopt;
  Curved curved;
  curved.middle = static_cast<std::int32_t>(middle);
  for (std::size_t k = 0; k < kNumbers; ++k)
    curved.numbers[k] = static_cast<std::int16_t>(words[1 + k / 2] >> (k % 2 == 0 ? 0U : 16U) & 0xFFFFU);
  return curved;
}
void set_words(const Curved& curved, int level, std::vector<std::uint32_t>& words) {
  words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(curved.middle * middle_step(level))));
  for (std::size_t k = 0; k < kNumbers; k += 2) {
    const auto low = static_cast<std::uint32_t>(curved.numbers[k]) & 0xFFFFU;
    const auto high = k + 1 < kNumbers ? static_cast<std::uint32_t>(curved.numbers[k + 1]) & 0xFFFFU : 0U;
    words.push_back(low | high << 16U);
  }
}

/// The piece of a leaf nearby, continued into the leaf at `to`.
Curved continued(const Curved& piece, const Place& from, const Place& to) {
  const double scale = to.half() / from.half();
  const auto way = [&](std::size_t axis) {
    return (to.corner[axis] + to.half() - from.corner[axis] - from.half()) / from.half();
  };
  const double x = way(0), y = way(1), z = way(2);
  const auto& n = piece.numbers;
  const auto number = [&](std::size_t k) { return LeafHead::kStep * n[k]; };
  const double lx = number(0), ly = number(1), lz = number(2), xx = number(3), yy = number(4), zz = number(5),
               xy = number(6), xz = number(7), yz = number(8);
  const double middle = piece.middle * middle_step(from.level) + x * (lx + xx * x + xy * y + xz * z) +
                        y * (ly + yy * y + yz * z) + z * (lz + zz * z);
  const std::array<double, kNumbers> moved{lx + 2 * xx * x + xy * y + xz * z,
                                           ly + 2 * yy * y + xy * x + yz * z,
                                           lz + 2 * zz * z + xz * x + yz * y,
                                           scale * xx,
                                           scale * yy,
                                           scale * zz,
                                           scale * xy,
                                           scale * xz,
                                           scale * yz};
  Curved curved;
  const auto held = [](double v) { return static_cast<std::int32_t>(std::clamp(v, -1e9, 1e9)); };
  curved.middle = held(std::round(middle / scale / middle_step(to.level)));
  const int multiple = LeafHead::multiple(to.level);
  for (std::size_t k = 0; k < kNumbers; ++k)
    curved.numbers[k] =
        std::clamp(multiple * held(std::round(moved[k] / (multiple * LeafHead::kStep))), -32768, 32767);
  return curved;
}

/// The last curved pieces, the latest first.
class RecentPieces {
 public:
  void add(const Curved& piece, const Place& place) {
    std::rotate(pieces_.begin(), pieces_.end() - 1, pieces_.end());
    pieces_.front() = {piece, place};
    count_ = std::min(count_ + 1, kRecent);
  }
  std::size_t count() const { return count_; }
  Curved predict(std::size_t k, const Place& place) const {
    return continued(pieces_[k].first, pieces_[k].second, place);
  }

 private:
  std::array<std::pair<Curved, Place>, kRecent> pieces_{};
  std::size_t count_ = 0;
};

using Plane = std::array<std::uint32_t, LeafHead::kPlaneWords>;
/// Planes in the order in which they were last met, the latest first; the oldest are forgotten.
class RecentPlanes {
 public:
  /// 1 for the latest, 0 for none; moves it to the front.
  std::uint32_t rank(const Plane& plane) {
    const auto at = std::find(planes_.begin(), planes_.end(), plane);
    const auto rank = at == planes_.end() ? 0U : static_cast<std::uint32_t>(at - planes_.begin()) + 1U;
    if (rank == 0) {
      add(plane);
    } else {
      std::rotate(planes_.begin(), at, at + 1);
    }
    return rank;
  }
  std::optional<Plane> take(std::uint32_t rank) {
    if (rank == 0 || rank > planes_.size()) return std::nullopt;
    const auto at = planes_.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
    std::rotate(planes_.begin(), at, at + 1);
    return planes_.front();
  }
  void add(const Plane& plane) {
    if (planes_.size() == kMost) planes_.pop_back();
    planes_.insert(planes_.begin(), plane);
  }

 private:
  static constexpr std::size_t kMost = 1024;
  std::vector<Plane> planes_;
};

class Writer {
 public:
  Writer(const FieldGrid& grid, const FieldTree& tree)
      : grid_(grid), tree_(tree), last_(tree.words.size(), std::numeric_limits<std::uint32_t>::max()) {}

  FieldStreams write() {
    for (std::size_t i = 0; i < tree_.roots.size(); ++i) add(tree_.roots[i], root_place(grid_, i));
    out_.bytes[FieldStreams::planes] = planes_of(new_planes_, LeafHead::kPlaneWords, 4);
    out_.bytes[FieldStreams::shapes] = planes_of(new_shapes_, kNumbers, 2);
    out_.bytes[FieldStreams::raw] = planes_of(raw_, LeafHead::kCurvedWords, 4);
    return std::move(out_);
  }

 private:
  void add(std::uint32_t entry, const Place& place) {
    const bool leaf = (entry & FieldTree::kLeaf) != 0;
    out_.bytes[FieldStreams::tree].push_back(leaf ? 1 : 0);
    if (!leaf) {
      for (unsigned k = 0; k < 8; ++k) add(tree_.nodes[8 * std::size_t{entry} + k], place.child(k));
      return;
    }
    const std::uint32_t at = entry & ~FieldTree::kLeaf;
    const bool known = last_[at] != std::numeric_limits<std::uint32_t>::max();
    put_count(out_.bytes[FieldStreams::shared], known ? leaves_ - last_[at] : 0);
    last_[at] = leaves_++;
    if (!known) add_words(&tree_.words[at], place);
  }

  void add_words(const std::uint32_t* words, const Place& place) {
    const LeafHead head{words[0]};
    out_.bytes[FieldStreams::heads].push_back(static_cast<std::uint8_t>(head.bits));
    const std::uint32_t* piece = words + 1 + 2 * (head.pieces() - 1);
    for (int i = 0; i < head.pieces(); ++i) {
      if (head.curved(i))
        add_curved(piece, place);
      else
        add_plane(piece);
      piece += head.curved(i) ? LeafHead::kCurvedWords : LeafHead::kPlaneWords;
    }
  }

  void add_plane(const std::uint32_t* words) {
    const Plane plane{words[0], words[1], words[2], words[3]};
    const std::uint32_t rank = planes_.rank(plane);
    put_count(out_.bytes[FieldStreams::plane_ranks], rank);
    if (rank == 0) new_planes_.insert(new_planes_.end(), plane.begin(), plane.end());
  }

  void add_curved(const std::uint32_t* words, const Place& place) {
    const auto steps = steps_of(words, place.level);
    if (!steps) {
      out_.bytes[FieldStreams::predictions].push_back(kRaw);
      raw_.insert(raw_.end(), words, words + LeafHead::kCurvedWords);
      return;
    }
    const auto cost = [&](const Curved& p) {
      double bits = std::log2(1.0 + std::abs(1.0 * steps->middle - p.middle));
      for (std::size_t k = 0; k < kNumbers; ++k)
        bits += std::log2(1.0 + std::abs(steps->numbers[k] - p.numbers[k]));
      return bits;
    };
    Curved best;
    std::uint8_t by = kByNothing;
    for (std::size_t k = 0; k < pieces_.count(); ++k) {
      const Curved p = pieces_.predict(k, place);
      if (cost(p) < cost(best)) best = p, by = static_cast<std::uint8_t>(k);
    }
    out_.bytes[FieldStreams::predictions].push_back(by);
    put_count(out_.bytes[FieldStreams::middles],
              folded(static_cast<std::int32_t>(static_cast<std::uint32_t>(steps->middle) -
                                               static_cast<std::uint32_t>(best.middle))));
    for (std::size_t k = 0; k < kNumbers; ++k)
      new_shapes_.push_back(folded(static_cast<std::int16_t>(steps->numbers[k] - best.numbers[k])) & 0xFFFFU);
    pieces_.add(*steps, place);
  }

  const FieldGrid& grid_;
  const FieldTree& tree_;
  FieldStreams out_;
  std::vector<std::uint32_t> last_, new_planes_, new_shapes_, raw_;
  RecentPlanes planes_;
  RecentPieces pieces_;
  std::uint32_t leaves_ = 0;
};

class Reader {
 public:
  Reader(const FieldGrid& grid, const FieldStreams& in)
      : grid_(grid),
        in_(in),
        new_planes_(words_of(in.bytes[FieldStreams::planes], LeafHead::kPlaneWords, 4)),
        new_shapes_(words_of(in.bytes[FieldStreams::shapes], kNumbers, 2)),
        raw_(words_of(in.bytes[FieldStreams::raw], LeafHead::kCurvedWords, 4)) {}

  Result<FieldTree> read(std::size_t roots) {
    tree_.roots.reserve(std::min(roots, in_.bytes[FieldStreams::tree].size()));
    for (std::size_t i = 0; i < roots && ok_; ++i) {
      const std::uint32_t entry = add(root_place(grid_, i));
      tree_.roots.push_back(entry);
    }
    if (!ok_ || at_[FieldStreams::tree] != in_.bytes[FieldStreams::tree].size())
      return invalid_input("holds a field that is damaged or cut off");
    return std::move(tree_);
  }

 private:
  std::uint32_t fail() {
    ok_ = false;
    return FieldTree::kLeaf;
  }
  std::optional<std::uint8_t> byte(FieldStreams::Name name) {
    if (at_[name] >= in_.bytes[name].size()) return std::nullopt;
    return in_.bytes[name][at_[name]++];
  }
  std::optional<std::uint32_t> count(FieldStreams::Name name) {
    return take_count(in_.bytes[name], at_[name]);
  }
  /// The next `size` words of a list; nullptr at its end.
  static const std::uint32_t* words(const std::vector<std::uint32_t>& list, std::size_t& at,
                                    std::size_t size) {
    if (list.size() - at < size) return nullptr;
    at += size;
    return &list[at - size];
  }

  std::uint32_t add(const Place& place) {
    const auto leaf = ok_ ? byte(FieldStreams::tree) : std::nullopt;
    if (!leaf) return fail();
    if (*leaf != 0) return add_leaf(place);
    if (place.level < 1) return fail();
    const std::size_t node = tree_.nodes.size() / 8;
    tree_.nodes.resize(tree_.nodes.size() + 8);
    for (unsigned k = 0; k < 8; ++k) {
      const std::uint32_t entry = add(place.child(k));
      tree_.nodes[8 * node + k] = entry;
    }
    return static_cast<std::uint32_t>(node);
  }

  std::uint32_t add_leaf(const Place& place) {
    const auto back = count(FieldStreams::shared);
    if (!back || *back > leaves_.size()) return fail();
    auto begin = static_cast<std::uint32_t>(tree_.words.size());
    if (*back > 0)
      begin = leaves_[leaves_.size() - *back];
    else if (!add_words(place))
      return fail();
    leaves_.push_back(begin);
    return begin | FieldTree::kLeaf;
  }

  bool add_words(const Place& place) {
    const auto bits = byte(FieldStreams::heads);
    if (!bits) return false;
    const LeafHead head{*bits};
    if (head.pieces() > 3) return false;
    const std::size_t begin = tree_.words.size();
    tree_.words.push_back(head.bits);
    tree_.words.resize(tree_.words.size() + 2 * static_cast<std::size_t>(head.pieces() - 1));
    for (int i = 0; i < head.pieces(); ++i)
      if (!(head.curved(i) ? add_curved(place) : add_plane())) return false;
    models::set_half_angles(&tree_.words[begin]);
    return true;
  }

  bool add_plane() {
    const auto rank = count(FieldStreams::plane_ranks);
    if (!rank) return false;
    if (*rank == 0) {
      const std::uint32_t* w = words(new_planes_, plane_at_, LeafHead::kPlaneWords);
      if (w == nullptr) return false;
      planes_.add({w[0], w[1], w[2], w[3]});
    }
    const auto plane = planes_.take(std::max(*rank, 1U));
    if (!plane) return false;
    tree_.words.insert(tree_.words.end(), plane->begin(), plane->end());
    return true;
  }

  bool add_curved(const Place& place) {
    const auto by = byte(FieldStreams::predictions);
    if (!by || *by > kRaw) return false;
    if (*by == kRaw) {
      const std::uint32_t* w = words(raw_, raw_at_, LeafHead::kCurvedWords);
      if (w == nullptr) return false;
      tree_.words.insert(tree_.words.end(), w, w + LeafHead::kCurvedWords);
      return true;
    }
    if (*by < kRecent && *by >= pieces_.count()) return false;
    const auto middle = count(FieldStreams::middles);
    const std::uint32_t* w = words(new_shapes_, shape_at_, kNumbers);
    if (!middle || w == nullptr) return false;
    Curved curved = *by == kByNothing ? Curved{} : pieces_.predict(*by, place);
    curved.middle = static_cast<std::int32_t>(static_cast<std::uint32_t>(curved.middle) +
                                              static_cast<std::uint32_t>(unfolded(*middle)));
    for (std::size_t k = 0; k < kNumbers; ++k)
      curved.numbers[k] = static_cast<std::int16_t>(curved.numbers[k] + unfolded(w[k]));
    set_words(curved, place.level, tree_.words);
    pieces_.add(curved, place);
    return true;
  }

  const FieldGrid& grid_;
  const FieldStreams& in_;
  std::vector<std::uint32_t> new_planes_, new_shapes_, raw_;
  FieldTree tree_;
  std::vector<std::uint32_t> leaves_;
  std::array<std::size_t, FieldStreams::kCount> at_{};
  std::size_t plane_at_ = 0, shape_at_ = 0, raw_at_ = 0;
  RecentPlanes planes_;
  RecentPieces pieces_;
  bool ok_ = true;
};

}  // namespace

FieldStreams streams_of(const FieldGrid& grid, const FieldTree& tree) { return Writer(grid, tree).write(); }

Result<FieldTree> tree_from(const FieldGrid& grid, const FieldStreams& streams) {
  std::size_t roots = 1;
  for (const int n : grid.roots) roots *= static_cast<std::size_t>(n);
  return Reader(grid, streams).read(roots);
}

}  // namespace palpable::formats
