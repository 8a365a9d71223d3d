// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/finer_fit.hpp"

#include "palpable/models/relief/rows_done.hpp"
#include "palpable/models/relief/spline_block.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace palpable::models {
namespace {

/// Of the work of making a ball's surface, until the first level.
constexpr WorkPart kTestPart{0.3, 0.5};
/// Parts of a cell at the first and at the finest level.
constexpr int kFirstParts = 4;
constexpr int kMostParts = 64;
/// A place with an error changes control values whose splines reach it, and needs errors known as far as
/// these splines reach: parts of the level.
constexpr int kAround = 4;
/// A control value is this combination of the errors at its knot and around it, every half part. It
/// reproduces cubic polynomials. Of all such symmetric combinations as wide as the spline it has the least
/// error at a kink: 0.081 times its change of slope times the part, to either side (found numerically; the
/// errors at the knots alone would give 0.19).
constexpr std::array<float, 5> kWeights{1.162350958F, 0.458652155F, -0.381677461F, -0.418827703F,
                                        0.260677522F};
constexpr int kReach = static_cast<int>(kWeights.size()) - 1;

/// A position with an error, pixels.
struct Miss {
  double x_px = 0.0;
  double y_px = 0.0;
  double off_m = 0.0;
};

/// A cell during the fit.
struct FitCell {
  FinerCell cell;
  /// For each part of the present level whether its errors are known; and the heights, the errors and the
  /// corrections: (2 parts)^2, (2 parts)^2, parts^2.
  std::vector<std::uint8_t> known;
  std::vector<float> exact_m;
  std::vector<float> error_m;
  std::vector<float> correction_m;
};

/// The control values of the same spline on a grid twice as fine (knot insertion), along one axis.
std::vector<float> inserted(const std::vector<float>& values, int count, int lines, std::size_t step,
                            std::size_t line_step, std::size_t new_step, std::size_t new_line_step) {
  const int finer = 2 * (count - 3) + 3;
  std::vector<float> result(static_cast<std::size_t>(finer) * static_cast<std::size_t>(lines));
  for (int line = 0; line < lines; ++line) {
    const float* const from = values.data() + static_cast<std::size_t>(line) * line_step;
    float* const to = result.data() + static_cast<std::size_t>(line) * new_line_step;
    const auto value = [&](int k) { return from[static_cast<std::size_t>(k) * step]; };
    // The first new value is half a part after the first old one.
    for (int k = 0; k < finer; ++k) {
      const int at = (k + 1) / 2;
      to[static_cast<std::size_t>(k) * new_step] =
          k % 2 == 0 ? 0.5F * (value(at) + value(at + 1))
                     : 0.125F * (value(at - 1) + value(at + 1)) + 0.75F * value(at);
    }
  }
  return result;
}

void make_finer(FinerCell& cell) {
  const int side = cell.parts + 3;
  const int finer = 2 * cell.parts + 3;
  const auto s = static_cast<std::size_t>(side);
  const auto f = static_cast<std::size_t>(finer);
  const std::vector<float> across = inserted(cell.values_m, side, side, 1, s, 1, f);
  cell.values_m = inserted(across, side, finer, f, 1, f, 1);
  cell.parts *= 2;
}

class Fitting {
 public:
  Fitting(const Relief& relief, const TouchPoints& contacts, const FinerFit& fit, const Work& work)
      : relief_(relief),
        contacts_(contacts),
        fit_(fit),
        work_(work),
        width_(relief.samples_m().width()),
        height_(relief.samples_m().height()),
        index_(width_, height_, -1) {}

  std::vector<FinerCell> run() {
    std::vector<Miss> misses = misses_of_relief();
    for (int parts = kFirstParts; parts <= kMostParts && !misses.empty() && !work_.cancelled(); parts *= 2) {
      work_.report(kTestPart.end + (1.0 - kTestPart.end) * parts / (2.0 * kMostParts),
                   "fitting the ball's surface in creases");
      misses = refine(parts, std::move(misses));
    }
    std::vector<FinerCell> cells;
    cells.reserve(cells_.size());
    for (FitCell& fitted : cells_) {
      FinerCell of_relief = cell_of_relief(fitted.cell.x, fitted.cell.y);
      while (of_relief.parts < fitted.cell.parts) make_finer(of_relief);
      // The difference of two splines is at most that of their control values.
      for (std::size_t k = 0; k < of_relief.values_m.size(); ++k)
        fitted.cell.lowered_m =
            std::max(fitted.cell.lowered_m, of_relief.values_m[k] - fitted.cell.values_m[k]);
      cells.push_back(std::move(fitted.cell));
    }
    return cells;
  }

 private:
  double x_m(double x_px) const { return (x_px - 0.5 * (width_ - 1)) * relief_.pixel_m(); }
  double y_m(double y_px) const { return (0.5 * (height_ - 1) - y_px) * relief_.pixel_m(); }
  bool may_be_finer(int x, int y) const { return x >= 1 && y >= 1 && x < width_ - 2 && y < height_ - 2; }

  /// Where the relief itself is not close enough, at every half pixel.
  std::vector<Miss> misses_of_relief() const {
    std::vector<std::vector<Miss>> rows(static_cast<std::size_t>(height_));
    RowsDone done(work_, height_, kTestPart);
    parallel_for(work_, height_ - 3, 4, [&](int begin, int end) {
      std::vector<TouchPoint> points;
      for (int y = begin + 1; y < end + 1 && !work_.cancelled(); ++y) {
        for (int x = 1; x < width_ - 2; ++x) {
          contacts_.of_cell(x, y, points);
          for (const auto& [right, down] : {std::pair{0.0, 0.0}, {0.5, 0.0}, {0.0, 0.5}, {0.5, 0.5}}) {
            const double at_x = x_m(x + right);
            const double at_y = y_m(y + down);
            const double off_m =
                std::abs(contacts_.centre_m(points, at_x, at_y) - relief_.sample(at_x, at_y).z_m);
            if (off_m > fit_.tolerance_m)
              rows[static_cast<std::size_t>(y)].push_back({x + right, y + down, off_m});
          }
        }
        done.add();
      }
    });
    return joined(rows);
  }

  static std::vector<Miss> joined(const std::vector<std::vector<Miss>>& lists) {
    std::vector<Miss> all;
    for (const std::vector<Miss>& list : lists) all.insert(all.end(), list.begin(), list.end());
    return all;
  }

  /// Calls visit(x, y) for the cells near a place that may be finer.
  template <class Visit>
  void each_cell_near(const Miss& miss, int parts, const Visit& visit) const {
    const auto part = [&](double px) { return static_cast<int>(px * parts); };
    for (int y = (part(miss.y_px) - kAround) / parts; y <= (part(miss.y_px) + kAround) / parts; ++y)
      for (int x = (part(miss.x_px) - kAround) / parts; x <= (part(miss.x_px) + kAround) / parts; ++x)
        if (may_be_finer(x, y)) visit(x, y);
  }

  /// Drops the places with the smallest errors, so that the control values are no more than allowed.
  void keep_affordable(int parts, std::vector<Miss>& misses) const {
    double used = 0.0;
    for (const FitCell& fitted : cells_) used += static_cast<double>(fitted.cell.values_m.size());
    constexpr double kHigher = 1.4;
    for (double least_m = fit_.tolerance_m; !misses.empty(); least_m *= kHigher) {
      std::erase_if(misses, [&](const Miss& miss) { return miss.off_m < least_m; });
      Raster<std::uint8_t> seen(width_, height_);
      double wanted = used;
      for (const Miss& miss : misses)
        each_cell_near(miss, parts, [&](int x, int y) {
          if (std::exchange(seen(x, y), std::uint8_t{1}) != 0) return;
          wanted += (parts + 3.0) * (parts + 3.0);
          if (index_(x, y) >= 0)
            wanted -=
                static_cast<double>(cells_[static_cast<std::size_t>(index_(x, y))].cell.values_m.size());
        });
      if (wanted <= fit_.most_values) return;
    }
  }

  FinerCell cell_of_relief(int x, int y) const {
    FinerCell cell{x, y, 1, {}, 0.0F};
    for (int b = -1; b <= 2; ++b)
      for (int a = -1; a <= 2; ++a) cell.values_m.push_back(relief_.samples_m()(x + a, y + b));
    return cell;
  }

  /// The cell as a member of this level.
  FitCell& member(int x, int y, int parts, std::vector<int>& members) {
    int& k = index_(x, y);
    if (k < 0) {
      k = static_cast<int>(cells_.size());
      cells_.push_back({cell_of_relief(x, y), {}, {}, {}, {}});
    }
    FitCell& fitted = cells_[static_cast<std::size_t>(k)];
    if (fitted.cell.parts < parts) {
      members.push_back(k);
      while (fitted.cell.parts < parts) make_finer(fitted.cell);
      fitted.known.assign(static_cast<std::size_t>(parts) * static_cast<std::size_t>(parts), 0);
    }
    return fitted;
  }

  /// One level: its corrections, and where these do not suffice.
  std::vector<Miss> refine(int parts, std::vector<Miss> misses) {
    keep_affordable(parts, misses);
    std::vector<int> members;
    for (const Miss& miss : misses)
      each_cell_near(miss, parts, [&](int x, int y) {
        FitCell& fitted = member(x, y, parts, members);
        const int i = static_cast<int>(miss.x_px * parts) - x * parts;
        const int j = static_cast<int>(miss.y_px * parts) - y * parts;
        for (int b = std::max(0, j - kAround); b <= std::min(parts - 1, j + kAround); ++b)
          for (int a = std::max(0, i - kAround); a <= std::min(parts - 1, i + kAround); ++a)
            fitted.known[static_cast<std::size_t>(b * parts + a)] = 1;
      });
    const auto each_member = [&](const auto& visit) {
      parallel_for(work_, static_cast<int>(members.size()), 4, [&](int begin, int end) {
        for (int k = begin; k < end && !work_.cancelled(); ++k)
          visit(static_cast<std::size_t>(k),
                cells_[static_cast<std::size_t>(members[static_cast<std::size_t>(k)])]);
      });
    };
    each_member([&](std::size_t, FitCell& fitted) { measure(fitted); });
    each_member([&](std::size_t, FitCell& fitted) { find_corrections(fitted); });
    each_member([&](std::size_t, FitCell& fitted) { correct(fitted); });
    std::vector<std::vector<Miss>> left(members.size());
    each_member([&](std::size_t k, FitCell& fitted) { left[k] = misses_of(fitted); });
    for (const int k : members) {
      FitCell& fitted = cells_[static_cast<std::size_t>(k)];
      fitted = {std::move(fitted.cell), {}, {}, {}, {}};
    }
    return joined(left);
  }

  /// Calls visit(i, j, index) for the half parts whose errors are known.
  template <class Visit>
  static void each_known(const FitCell& fitted, const Visit& visit) {
    const int parts = fitted.cell.parts;
    for (int b = 0; b < 2 * parts; ++b)
      for (int a = 0; a < 2 * parts; ++a)
        if (fitted.known[static_cast<std::size_t>(b / 2 * parts + a / 2)] != 0)
          visit(a, b, static_cast<std::size_t>(b * 2 * parts + a));
  }

  static double height_m(const FinerCell& cell, int a, int b) {
    const std::size_t stride = static_cast<std::size_t>(cell.parts) + 3;
    const float* const first =
        cell.values_m.data() + static_cast<std::size_t>(b / 2) * stride + static_cast<std::size_t>(a / 2);
    return SplineBlock({first, stride, 0.5 * (a % 2), 0.5 * (b % 2)}).evaluate().z;
  }

  void measure(FitCell& fitted) const {
    const FinerCell& cell = fitted.cell;
    const std::size_t count = 4 * fitted.known.size();
    fitted.exact_m.assign(count, 0.0F);
    fitted.error_m.assign(count, 0.0F);
    fitted.correction_m.assign(fitted.known.size(), 0.0F);
    std::vector<TouchPoint> points;
    contacts_.of_cell(cell.x, cell.y, points);
    each_known(fitted, [&](int a, int b, std::size_t k) {
      const double exact_m =
          contacts_.centre_m(points, x_m(cell.x + 0.5 * a / cell.parts), y_m(cell.y + 0.5 * b / cell.parts));
      fitted.exact_m[k] = static_cast<float>(exact_m);
      fitted.error_m[k] = static_cast<float>(exact_m - height_m(cell, a, b));
    });
  }

  /// The member of this level that contains part (i, j) counted from a cell, and the part in it.
  const FitCell* member_at(const FitCell& from, int& i, int& j) const {
    const int parts = from.cell.parts;
    const int right = i < 0 ? -1 : i >= parts ? 1 : 0;
    const int down = j < 0 ? -1 : j >= parts ? 1 : 0;
    if (right == 0 && down == 0) return &from;
    const int k = index_(from.cell.x + right, from.cell.y + down);
    if (k < 0 || cells_[static_cast<std::size_t>(k)].known.empty()) return nullptr;
    i -= right * parts;
    j -= down * parts;
    return &cells_[static_cast<std::size_t>(k)];
  }

  bool is_known(const FitCell& from, int i, int j) const {
    const FitCell* const at = member_at(from, i, j);
    return at != nullptr && at->known[static_cast<std::size_t>(j * from.cell.parts + i)] != 0;
  }

  float error_m(const FitCell& from, int a, int b) const {
    // Rounded down, also left of the cell.
    int i = (a + 2 * from.cell.parts) / 2 - from.cell.parts;
    int j = (b + 2 * from.cell.parts) / 2 - from.cell.parts;
    const int half_right = a - 2 * i;
    const int half_down = b - 2 * j;
    const FitCell* const at = member_at(from, i, j);
    return at
        ->error_m[static_cast<std::size_t>((2 * j + half_down) * 2 * from.cell.parts + 2 * i + half_right)];
  }

  /// The corrections of the control values in the cell whose splines end where errors are known, so that the
  /// surface beyond does not change.
  void find_corrections(FitCell& fitted) const {
    const int parts = fitted.cell.parts;
    for (int j = 0; j < parts; ++j)
      for (int i = 0; i < parts; ++i) {
        bool is_free = true;
        for (int b = -kReach / 2; b <= kReach / 2 && is_free; ++b)
          for (int a = -kReach / 2; a <= kReach / 2 && is_free; ++a) is_free = is_known(fitted, i + a, j + b);
        if (!is_free) continue;
        float sum = 0.0F;
        for (int b = -kReach; b <= kReach; ++b)
          for (int a = -kReach; a <= kReach; ++a)
            sum += kWeights[static_cast<std::size_t>(std::abs(a))] *
                   kWeights[static_cast<std::size_t>(std::abs(b))] * error_m(fitted, 2 * i + a, 2 * j + b);
        fitted.correction_m[static_cast<std::size_t>(j * parts + i)] = sum;
      }
  }

  void correct(FitCell& fitted) const {
    const int parts = fitted.cell.parts;
    for (int j = -1; j <= parts + 1; ++j)
      for (int i = -1; i <= parts + 1; ++i) {
        int in_x = i;
        int in_y = j;
        const FitCell* const at = member_at(fitted, in_x, in_y);
        if (at == nullptr) continue;
        fitted.cell.values_m[static_cast<std::size_t>((j + 1) * (parts + 3) + i + 1)] +=
            at->correction_m[static_cast<std::size_t>(in_y * parts + in_x)];
      }
  }

  std::vector<Miss> misses_of(const FitCell& fitted) const {
    std::vector<Miss> misses;
    const FinerCell& cell = fitted.cell;
    each_known(fitted, [&](int a, int b, std::size_t k) {
      const double off_m = std::abs(static_cast<double>(fitted.exact_m[k]) - height_m(cell, a, b));
      if (off_m > fit_.tolerance_m)
        misses.push_back({cell.x + 0.5 * a / cell.parts, cell.y + 0.5 * b / cell.parts, off_m});
    });
    return misses;
  }

  const Relief& relief_;
  const TouchPoints& contacts_;
  const FinerFit& fit_;
  const Work& work_;
  int width_;
  int height_;
  std::vector<FitCell> cells_;
  Raster<int> index_;
};

}  // namespace

std::vector<FinerCell> fit_finer_cells(const Relief& relief, const TouchPoints& contacts, const FinerFit& fit,
                                       const Work& work) {
  return Fitting(relief, contacts, fit, work).run();
}

}  // namespace palpable::models
