// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/refined_dilation.hpp"

#include "palpable/core/check.hpp"
#include "palpable/models/relief/relief_dilation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace palpable::models {
namespace {

using Cell = ReliefCells::Cell;

/// Slopes of the dilated surface, exact at its samples.
struct Slope {
  double x = 0.0;
  double down = 0.0;
};

Slope slope_of(const BallContact& contact, double radius_m, double steepest) {
  const double dx = contact.at.dx;
  const double dy = contact.at.dy;
  const double over_m =
      std::sqrt(std::max(1e-6 * radius_m * radius_m, radius_m * radius_m - dx * dx - dy * dy));
  const auto limited = [&](double slope) { return std::clamp(slope, -steepest, steepest); };
  return {limited(dx / over_m), -limited(dy / over_m)};
}

/// Marks the cells in which a spline through the samples differs from the dilated surface.
class CoarseCells {
 public:
  CoarseCells(const Raster<BallContact>& contacts, const Relief& relief, double radius_m)
      : slopes_(contacts.width(), contacts.height()), marks_(contacts.width(), contacts.height(), 0) {
    for (std::size_t k = 0; k < contacts.count(); ++k)
      slopes_.data()[k] = slope_of(contacts.data()[k], radius_m, relief.steepest_slope());
  }

  /// The cells with an error above `tolerance` pixels. A spline through the samples of a crease, with a step
  /// s of its slope, is off by up to a quarter of s pixels; the third difference of the slopes is 2 s there.
  std::vector<Cell> above(double tolerance) {
    // The control values at a sharp crease also change the spline two cells beside it.
    constexpr double kWide = 4.0;
    std::fill(marks_.values().begin(), marks_.values().end(), std::uint8_t{0});
    for (int y = 0; y < slopes_.height(); ++y)
      for (int x = 0; x < slopes_.width(); ++x) {
        const double across = error(slope_x(x - 1, y), slope_x(x, y), slope_x(x + 1, y), slope_x(x + 2, y));
        const double down =
            error(slope_down(x, y - 1), slope_down(x, y), slope_down(x, y + 1), slope_down(x, y + 2));
        const int wide = across > kWide * tolerance ? 1 : 0;
        const int high = down > kWide * tolerance ? 1 : 0;
        if (across > tolerance) mark({x - wide, y - 1}, {x + wide, y});
        if (down > tolerance) mark({x - 1, y - high}, {x, y + high});
      }
    std::vector<Cell> cells;
    for (int y = 1; y < slopes_.height() - 2; ++y)
      for (int x = 1; x < slopes_.width() - 2; ++x)
        if (marks_(x, y) != 0) cells.push_back({x, y});
    return cells;
  }

 private:
  static double error(double a, double b, double c, double d) {
    const double along_normal = 1.0 / std::sqrt(1.0 + std::min(b * b, c * c));
    return 0.125 * std::abs(d - 3.0 * c + 3.0 * b - a) * along_normal;
  }
  const Slope& at(int x, int y) const {
    return slopes_(std::clamp(x, 0, slopes_.width() - 1), std::clamp(y, 0, slopes_.height() - 1));
  }
  double slope_x(int x, int y) const { return at(x, y).x; }
  double slope_down(int x, int y) const { return at(x, y).down; }

  void mark(Cell first, Cell last) {
    for (int y = std::max(0, first.y); y <= std::min(last.y, marks_.height() - 1); ++y)
      for (int x = std::max(0, first.x); x <= std::min(last.x, marks_.width() - 1); ++x) marks_(x, y) = 1;
  }

  Raster<Slope> slopes_;
  Raster<std::uint8_t> marks_;
};

/// The corner of a cell in the scene, and its side.
struct CellFrame {
  double left_m = 0.0;
  double top_m = 0.0;
  double side_m = 0.0;
};

/// The ball on one wall, over one cell: a smooth surface. It is interpolated between nodes where these agree
/// with a cubic, and computed for each fine pixel otherwise (where the wall ends, or on the steep side of a
/// small ball).
class ContactBranch {
 public:
  /// With `fine` pixels in the cell; few of them are cheaper without nodes.
  ContactBranch(const Relief& relief, double radius_m, CellFrame frame, UnderBall start, int fine)
      : relief_(relief), radius_m_(radius_m), frame_(frame), start_(start), has_nodes_(fine > 2 * kParts) {
    if (has_nodes_) find_nodes();
  }

  UnderBall start() const { return start_; }
  bool is_cubic() const { return is_cubic_; }

  /// heights = max(heights, the branch's heights) over n x n fine pixels. A branch that is no cubic is
  /// computed only where it may be the greatest.
  void raise(float* heights, int n) const {
    const double slack_m = 0.2 * frame_.side_m;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        float& height_m = heights[j * n + i];
        double branch_m = has_nodes_ ? interpolated(1.0 * i / n, 1.0 * j / n) : 0.0;
        if (!is_cubic_) {
          if (has_nodes_ && branch_m < double{height_m} - slack_m) continue;
          branch_m = converged_m(1.0 * i / n, 1.0 * j / n);
        }
        height_m = std::max(height_m, static_cast<float>(branch_m));
      }
  }

 private:
  static constexpr int kParts = 3;
  struct Node {
    BallContact contact;
    /// Its slopes, in metres per part of the cell.
    double right_m = 0.0;
    double down_m = 0.0;
  };

  void find_nodes() {
    for (int j = 0; j <= kParts; ++j)
      for (int i = 0; i <= kParts; ++i) {
        const UnderBall from = i > 0 ? node(i - 1, j).contact.at : j > 0 ? node(0, j - 1).contact.at : start_;
        Node& here = nodes_[static_cast<std::size_t>(j * (kParts + 1) + i)];
        here.contact = touch(1.0 * i / kParts, 1.0 * j / kParts, from);
        const Slope slope = slope_of(here.contact, radius_m_, std::max(1.0, relief_.steepest_slope()));
        here.right_m = slope.x * frame_.side_m / kParts;
        here.down_m = slope.down * frame_.side_m / kParts;
      }
    is_cubic_ = nodes_agree();
  }

  const Node& node(int i, int j) const { return nodes_[static_cast<std::size_t>(j * (kParts + 1) + i)]; }

  /// The ball's contact at a share of the cell to the right and down.
  BallContact touch(double right, double down, UnderBall from) const {
    return touch_by_ball(relief_, radius_m_, frame_.left_m + right * frame_.side_m,
                         frame_.top_m - down * frame_.side_m, from);
  }

  /// The height at one place. In the tip of a cone the ball touches all around, and the way to its best
  /// contact is long.
  double converged_m(double right, double down) const {
    constexpr int kTries = 8;
    constexpr double kInside = 0.98;
    BallContact contact = touch(right, down, start_);
    double height_m = contact.height_m;
    for (int k = 1; k < kTries && !contact.found; ++k) {
      if (std::hypot(contact.at.dx, contact.at.dy) > kInside * radius_m_) break;
      contact = touch(right, down, contact.at);
      height_m = std::max(height_m, contact.height_m);
    }
    return height_m;
  }

  /// Whether heights and slopes of neighbouring nodes belong to one cubic, within a micrometre, and their
  /// contacts to one wall.
  bool nodes_agree() const {
    for (int j = 0; j <= kParts; ++j)
      for (int i = 0; i <= kParts; ++i) {
        const Node& a = node(i, j);
        if (i < kParts && !agree(a.contact, node(i + 1, j).contact, a.right_m + node(i + 1, j).right_m))
          return false;
        if (j < kParts && !agree(a.contact, node(i, j + 1).contact, a.down_m + node(i, j + 1).down_m))
          return false;
      }
    return true;
  }
  bool agree(const BallContact& a, const BallContact& b, double slopes_m) const {
    constexpr double kAgree_m = 1e-6;
    constexpr double kJump = 1.5;
    return a.found && b.found && std::abs(b.height_m - a.height_m - 0.5 * slopes_m) <= kAgree_m &&
           std::hypot(b.at.dx - a.at.dx, b.at.dy - a.at.dy) <= kJump / kParts * frame_.side_m;
  }

  static double hermite(double a, double slope_a, double b, double slope_b, double t) {
    const double u = 1.0 - t;
    return u * u * ((1.0 + 2.0 * t) * a + t * slope_a) + t * t * ((1.0 + 2.0 * u) * b - u * slope_b);
  }

  double interpolated(double right, double down) const {
    const int i = std::min(static_cast<int>(right * kParts), kParts - 1);
    const int j = std::min(static_cast<int>(down * kParts), kParts - 1);
    const double u = right * kParts - i;
    const double v = down * kParts - j;
    const Node& a = node(i, j);
    const Node& b = node(i + 1, j);
    const Node& c = node(i, j + 1);
    const Node& d = node(i + 1, j + 1);
    return hermite(hermite(a.contact.height_m, a.down_m, c.contact.height_m, c.down_m, v),
                   a.right_m + v * (c.right_m - a.right_m),
                   hermite(b.contact.height_m, b.down_m, d.contact.height_m, d.down_m, v),
                   b.right_m + v * (d.right_m - b.right_m), u);
  }

  const Relief& relief_;
  double radius_m_;
  CellFrame frame_;
  UnderBall start_;
  std::array<Node, static_cast<std::size_t>((kParts + 1) * (kParts + 1))> nodes_;
  bool has_nodes_ = false;
  bool is_cubic_ = false;
};

/// Computes the fine control values of the marked cells.
class CellRefiner {
 public:
  CellRefiner(const Relief& relief, double radius_m, const Raster<BallContact>& contacts,
              const Relief& dilated, ReliefCells& out)
      : relief_(relief),
        radius_m_(radius_m),
        contacts_(contacts),
        dilated_(dilated),
        out_(out),
        n_(out.per_pixel),
        index_(contacts.width(), contacts.height(), -1),
        heights_(out.cells.size() * block()) {
    for (std::size_t k = 0; k < out.cells.size(); ++k)
      index_(out.cells[k].x, out.cells[k].y) = static_cast<std::int32_t>(k);
  }

  void refine(const Work& work) {
    const int count = static_cast<int>(out_.cells.size());
    const auto side = static_cast<std::size_t>(n_ + 3);
    out_.values.resize(out_.cells.size() * side * side);
    parallel_for(work, count, 16, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) roll_in(static_cast<std::size_t>(k));
    });
    parallel_for(work, count, 64, [&](int begin, int end) {
      for (int k = begin; k < end; ++k)
        fill(static_cast<std::size_t>(k), out_.values.data() + static_cast<std::size_t>(k) * side * side);
    });
  }

 private:
  std::size_t block() const { return static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_); }
  bool is_refined(int x, int y) const { return index_(x, y) >= 0; }

  /// Heights of the ball over the fine pixels of a cell: the greatest of its branches. These begin at the
  /// contacts that the ball has over the cell's corners: in a crease they lie on different walls.
  void roll_in(std::size_t k) {
    const Cell cell = out_.cells[k];
    const double pixel_m = relief_.pixel_m();
    const CellFrame frame{(cell.x - 0.5 * (contacts_.width() - 1)) * pixel_m,
                          (0.5 * (contacts_.height() - 1) - cell.y) * pixel_m, pixel_m};
    float* const heights = heights_.data() + k * block();
    std::fill_n(heights, block(), -std::numeric_limits<float>::infinity());
    std::vector<ContactBranch> branches;
    for (const BallContact& c : {contacts_(cell.x, cell.y), contacts_(cell.x + 1, cell.y),
                                 contacts_(cell.x, cell.y + 1), contacts_(cell.x + 1, cell.y + 1)}) {
      const bool is_known = std::any_of(branches.begin(), branches.end(), [&](const ContactBranch& b) {
        return std::hypot(b.start().dx - c.at.dx, b.start().dy - c.at.dy) < kSame * pixel_m;
      });
      if (!is_known) branches.emplace_back(relief_, radius_m_, frame, c.at, n_);
    }
    for (const bool cubic : {true, false})
      for (const ContactBranch& branch : branches)
        if (branch.is_cubic() == cubic) branch.raise(heights, n_);
  }

  /// The height at a fine pixel (i, j) of a cell, which may lie in a neighbour.
  double height(Cell cell, int i, int j) const {
    const int x = cell.x + (i < 0 ? -1 : i / n_);
    const int y = cell.y + (j < 0 ? -1 : j / n_);
    const int in_x = i - (x - cell.x) * n_;
    const int in_y = j - (y - cell.y) * n_;
    return heights_[static_cast<std::size_t>(index_(x, y)) * block() +
                    static_cast<std::size_t>(in_y * n_ + in_x)];
  }

  /// Whether a fine control value lies within a fine pixel of a cell that is not refined. There the spline is
  /// the coarse one, so that height, slope and curvature are continuous.
  bool is_fixed(Cell cell, int i, int j) const {
    const int x0 = i <= 1 ? -1 : 0;
    const int x1 = i >= n_ - 1 ? 1 : 0;
    const int y0 = j <= 1 ? -1 : 0;
    const int y1 = j >= n_ - 1 ? 1 : 0;
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        if (!is_refined(cell.x + x, cell.y + y)) return true;
    return false;
  }

  void fill(std::size_t k, float* values) const {
    const Cell cell = out_.cells[k];
    subdivide_cell(dilated_, cell, n_, values);
    for (int j = -1; j <= n_ + 1; ++j)
      for (int i = -1; i <= n_ + 1; ++i) {
        if (is_fixed(cell, i, j)) continue;
        const double here = height(cell, i, j);
        const double bent = height(cell, i - 1, j) + height(cell, i + 1, j) + height(cell, i, j - 1) +
                            height(cell, i, j + 1) - 4.0 * here;
        values[(j + 1) * (n_ + 3) + i + 1] = static_cast<float>(here - kSharpened * bent);
      }
  }

  /// Contacts that are nearer than this, in pixels, are one.
  static constexpr double kSame = 0.25;
  /// The spline lowers its control values by a sixth of their second differences. With this share instead, a
  /// crease is represented with the least greatest error, 0.2 fine pixels times its slope to either side;
  /// round ground is 1e-8 m too low.
  static constexpr double kSharpened = 0.36;

  const Relief& relief_;
  double radius_m_;
  const Raster<BallContact>& contacts_;
  const Relief& dilated_;
  ReliefCells& out_;
  int n_;
  Raster<std::int32_t> index_;
  std::vector<float> heights_;
};

/// The most control values of refined cells, 2 MB. A relief whose creases need more, as noise does, is not
/// refined: each cell that is read for the first time costs a tick a cache miss.
constexpr double kMostValues = 5e5;
constexpr int kLeastFine = 8;

/// Fine pixels per pixel for so many cells.
int fine_pixels(double pixel_m, std::size_t cells) {
  constexpr double kFine_m = 12.5e-6;
  constexpr double kMost = 64.0;
  const double affordable = std::sqrt(kMostValues / std::max(1.0, static_cast<double>(cells))) - 3.0;
  return std::max(kLeastFine, static_cast<int>(std::min({std::ceil(pixel_m / kFine_m), kMost, affordable})));
}

bool are_too_many(std::size_t cells) {
  constexpr double kSide = kLeastFine + 3;
  return kSide * kSide * static_cast<double>(cells) > kMostValues;
}

}  // namespace

std::shared_ptr<const RefinedRelief> dilate_finely_by_ball(const Relief& relief, double radius_m,
                                                           const Work& work) {
  constexpr double kTolerance_m = 2.5e-6;
  const Raster<BallContact> contacts = roll_ball(relief, radius_m, work);
  auto made = Relief::from_samples(control_values_of(contacts, relief, radius_m), relief.pixel_m());
  PALPABLE_CHECK(made.has_value());
  const auto dilated = std::make_shared<const Relief>(std::move(*made));
  ReliefCells out;
  out.cells = CoarseCells(contacts, relief, radius_m).above(kTolerance_m / relief.pixel_m());
  if (are_too_many(out.cells.size())) out.cells.clear();
  out.per_pixel = fine_pixels(relief.pixel_m(), out.cells.size());
  CellRefiner(relief, radius_m, contacts, *dilated, out).refine(work);
  return std::make_shared<const RefinedRelief>(dilated, std::move(out));
}

}  // namespace palpable::models
