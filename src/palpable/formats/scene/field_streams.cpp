// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/field_streams.hpp"

#include "palpable/formats/scene/field_pieces.hpp"
#include "palpable/models/field/field_leaf.hpp"

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

using models::CompactQuadratic;
using models::FieldGrid;
using models::FieldTree;
using models::LeafHead;

/// Values in `predictions` after the indices of the recent pieces: no prediction, and raw words.
constexpr std::uint8_t kByNothing = RecentPieces::kMost, kRaw = kByNothing + 1;

/// Variable-length integer (LEB128): seven bits per byte, the high bit cleared in the last byte.
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
/// Zigzag coding.
std::uint32_t folded(std::int32_t v) {
  return static_cast<std::uint32_t>(v) << 1U ^ static_cast<std::uint32_t>(v >> 31);
}
std::int32_t unfolded(std::uint32_t v) {
  return static_cast<std::int32_t>(v >> 1U) ^ -static_cast<std::int32_t>(v & 1U);
}

/// Splits records of `size` words into byte planes: by word, then by byte.
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

class Writer {
 public:
  Writer(const FieldGrid& grid, const FieldTree& tree)
      : grid_(grid), tree_(tree), last_(tree.words.size(), std::numeric_limits<std::uint32_t>::max()) {}

  FieldStreams write() {
    for (std::size_t i = 0; i < tree_.roots.size(); ++i) add(tree_.roots[i], root_position(grid_, i));
    out_.bytes[FieldStreams::planes] = planes_of(new_planes_, LeafHead::kPlaneWords, 4);
    out_.bytes[FieldStreams::shapes] = planes_of(new_shapes_, Curved::kNumbers, 2);
    out_.bytes[FieldStreams::compact_numbers] = planes_of(new_compact_, Curved::kNumbers, 2);
    out_.bytes[FieldStreams::raw] = planes_of(raw_, LeafHead::kCurvedWords, 4);
    return std::move(out_);
  }

 private:
  void add(std::uint32_t entry, const LeafPosition& place) {
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

  void add_words(const std::uint32_t* words, const LeafPosition& place) {
    const LeafHead head{words[0]};
    out_.bytes[FieldStreams::heads].push_back(static_cast<std::uint8_t>(head.bits));
    if (head.compact()) return add_compact(words, place);
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

  void add_curved(const std::uint32_t* words, const LeafPosition& place) {
    const auto steps = steps_of(words, place.level);
    if (!steps) {
      out_.bytes[FieldStreams::predictions].push_back(kRaw);
      raw_.insert(raw_.end(), words, words + LeafHead::kCurvedWords);
      return;
    }
    const auto residual = residual_of(
        *steps, [&](const QuadraticValues& values) { return rounded_curved(values, place.level); }, place);
    put_count(out_.bytes[FieldStreams::middles], residual.middle);
    for (const std::uint32_t number : residual.numbers) new_shapes_.push_back(number & 0xFFFFU);
    pieces_.add(values_of(*steps, place.level), place);
  }

  void add_compact(const std::uint32_t* words, const LeafPosition& place) {
    const CompactQuadratic steps = models::compact_of(words);
    const auto residual = residual_of(steps, rounded_compact, place);
    put_count(out_.bytes[FieldStreams::compact_middles], residual.middle);
    for (const std::uint32_t number : residual.numbers) new_compact_.push_back(number & 0xFFFFU);
    pieces_.add(values_of(steps), place);
  }

  struct Residual {
    std::uint32_t middle = 0;
    std::array<std::uint32_t, Curved::kNumbers> numbers{};
  };
  /// The residual of a quantised piece to the nearest prediction, which `round` quantises; records which
  /// prediction.
  template <class Steps, class Round>
  Residual residual_of(const Steps& steps, const Round& round, const LeafPosition& place) {
    // Rises with the number of bits: their sum is the logarithm of this product, below 2^190.
    const auto cost_of = [&](const Steps& p) {
      double product = 1.0 + std::abs(1.0 * steps.middle - p.middle);
      for (std::size_t k = 0; k < Curved::kNumbers; ++k)
        product *= 1.0 + std::abs(steps.numbers[k] - p.numbers[k]);
      return product;
    };
    Steps best;
    double least = cost_of(best);
    std::uint8_t by = kByNothing;
    for (std::size_t k = 0; k < pieces_.count(); ++k) {
      const Steps p = round(pieces_.predict(k, place));
      const double cost = cost_of(p);
      if (cost < least) best = p, least = cost, by = static_cast<std::uint8_t>(k);
    }
    out_.bytes[FieldStreams::predictions].push_back(by);
    Residual residual;
    residual.middle = folded(static_cast<std::int32_t>(static_cast<std::uint32_t>(steps.middle) -
                                                       static_cast<std::uint32_t>(best.middle)));
    for (std::size_t k = 0; k < Curved::kNumbers; ++k)
      residual.numbers[k] = folded(static_cast<std::int16_t>(steps.numbers[k] - best.numbers[k]));
    return residual;
  }

  const FieldGrid& grid_;
  const FieldTree& tree_;
  FieldStreams out_;
  std::vector<std::uint32_t> last_, new_planes_, new_shapes_, new_compact_, raw_;
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
        new_shapes_(words_of(in.bytes[FieldStreams::shapes], Curved::kNumbers, 2)),
        new_compact_(words_of(in.bytes[FieldStreams::compact_numbers], Curved::kNumbers, 2)),
        raw_(words_of(in.bytes[FieldStreams::raw], LeafHead::kCurvedWords, 4)) {}

  Result<FieldTree> read(std::size_t roots) {
    tree_.roots.reserve(std::min(roots, in_.bytes[FieldStreams::tree].size()));
    for (std::size_t i = 0; i < roots && ok_; ++i) {
      const std::uint32_t entry = add(root_position(grid_, i));
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
  /// The next `size` words of a list; nullptr at the end.
  static const std::uint32_t* words(const std::vector<std::uint32_t>& list, std::size_t& at,
                                    std::size_t size) {
    if (list.size() - at < size) return nullptr;
    at += size;
    return &list[at - size];
  }

  std::uint32_t add(const LeafPosition& place) {
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

  std::uint32_t add_leaf(const LeafPosition& place) {
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

  bool add_words(const LeafPosition& place) {
    const auto bits = byte(FieldStreams::heads);
    if (!bits) return false;
    const LeafHead head{*bits};
    if (head.compact()) return add_compact(place);
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

  bool add_curved(const LeafPosition& place) {
    const auto by = byte(FieldStreams::predictions);
    if (!by || *by > kRaw) return false;
    if (*by == kRaw) {
      const std::uint32_t* w = words(raw_, raw_at_, LeafHead::kCurvedWords);
      if (w == nullptr) return false;
      tree_.words.insert(tree_.words.end(), w, w + LeafHead::kCurvedWords);
      return true;
    }
    const auto middle = count(FieldStreams::middles);
    const std::uint32_t* w = words(new_shapes_, shape_at_, Curved::kNumbers);
    const auto values = predicted(*by, place);
    if (!middle || w == nullptr || !values) return false;
    Curved curved = *by == kByNothing ? Curved{} : rounded_curved(*values, place.level);
    add_residual(curved, *middle, w);
    for (std::int32_t& number : curved.numbers) number = static_cast<std::int16_t>(number);
    set_words(curved, place.level, tree_.words);
    pieces_.add(values_of(curved, place.level), place);
    return true;
  }

  bool add_compact(const LeafPosition& place) {
    const auto by = byte(FieldStreams::predictions);
    if (!by || *by > kByNothing) return false;
    const auto middle = count(FieldStreams::compact_middles);
    const std::uint32_t* w = words(new_compact_, compact_at_, Curved::kNumbers);
    const auto values = predicted(*by, place);
    if (!middle || w == nullptr || !values) return false;
    CompactQuadratic compact = *by == kByNothing ? CompactQuadratic{} : rounded_compact(*values);
    add_residual(compact, *middle, w);
    if (!compact.fits()) return false;
    const auto leaf = models::words_of(compact);
    tree_.words.insert(tree_.words.end(), leaf.begin(), leaf.end());
    pieces_.add(values_of(compact), place);
    return true;
  }

  /// The prediction for a leaf; nullopt if there is no such piece.
  std::optional<QuadraticValues> predicted(std::uint8_t by, const LeafPosition& place) const {
    if (by == kByNothing) return QuadraticValues{};
    if (by >= pieces_.count()) return std::nullopt;
    return pieces_.predict(by, place);
  }
  template <class Steps>
  static void add_residual(Steps& steps, std::uint32_t middle, const std::uint32_t* numbers) {
    steps.middle = static_cast<std::int32_t>(static_cast<std::uint32_t>(steps.middle) +
                                             static_cast<std::uint32_t>(unfolded(middle)));
    for (std::size_t k = 0; k < Curved::kNumbers; ++k) steps.numbers[k] += unfolded(numbers[k]);
  }

  const FieldGrid& grid_;
  const FieldStreams& in_;
  std::vector<std::uint32_t> new_planes_, new_shapes_, new_compact_, raw_;
  FieldTree tree_;
  std::vector<std::uint32_t> leaves_;
  std::array<std::size_t, FieldStreams::kCount> at_{};
  std::size_t plane_at_ = 0, shape_at_ = 0, compact_at_ = 0, raw_at_ = 0;
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
