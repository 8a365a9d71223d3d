// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/room.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>

namespace palpable::study {
namespace {

/// Free space around what does not stand at a wall, and before what does: a disc of 0.35 m radius passes.
constexpr double kClearance_m = 0.72;
/// How far what stands at a wall or on a surface reaches into it.
constexpr double kReach_m = 0.01;

/// Numbers from a seed, the same with every standard library.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }
  /// 0 ... n - 1.
  int below(int n) { return static_cast<int>(between(0.0, n)); }

 private:
  std::mt19937_64 engine_;
};

/// A piece in its own axes: the middle of its footprint on the floor is the origin, its back is towards -y.
struct Piece {
  std::string name;
  double half_x_m = 0.0, half_y_m = 0.0;
  std::vector<Solid> solids;
};

Solid box(double x, double y, double z_low, double z_high, double half_x, double half_y) {
  return {Solid::Shape::box, {x, y, (z_low + z_high) / 2.0}, {half_x, half_y, (z_high - z_low) / 2.0}, 0.0};
}

Solid cylinder(double x, double y, double z_low, double z_high, double radius) {
  return {
      Solid::Shape::cylinder, {x, y, (z_low + z_high) / 2.0}, {radius, radius, (z_high - z_low) / 2.0}, 0.0};
}

/// A board at `height_m` (its top) on four square legs.
void add_board_on_legs(Piece& piece, double height_m, double leg_half_m) {
  constexpr double kBoard_m = 0.04;
  const double x = piece.half_x_m - leg_half_m - 0.02;
  const double y = piece.half_y_m - leg_half_m - 0.02;
  piece.solids.push_back(box(0, 0, height_m - kBoard_m, height_m, piece.half_x_m, piece.half_y_m));
  for (const auto& [sx, sy] : {std::pair(-1, -1), std::pair(-1, 1), std::pair(1, -1), std::pair(1, 1)})
    piece.solids.push_back(box(sx * x, sy * y, -kReach_m, height_m - kBoard_m / 2.0, leg_half_m, leg_half_m));
}

Piece table(Dice& dice) {
  Piece p{"table", dice.between(0.5, 0.75), dice.between(0.32, 0.42), {}};
  add_board_on_legs(p, dice.between(0.70, 0.76), 0.03);
  return p;
}

Piece chair(Dice& dice) {
  Piece p{"chair", 0.21, 0.21, {}};
  const double seat = dice.between(0.43, 0.48);
  add_board_on_legs(p, seat, 0.02);
  p.solids.push_back(box(0, -0.19, seat - 0.02, seat + 0.42, 0.21, 0.02));
  return p;
}

Piece stool(Dice& dice) {
  const double r = dice.between(0.15, 0.2);
  return {"stool", r, r, {cylinder(0, 0, -kReach_m, dice.between(0.4, 0.5), r)}};
}

Piece bin(Dice& dice) {
  const double r = dice.between(0.11, 0.15);
  return {"bin", r, r, {cylinder(0, 0, -kReach_m, dice.between(0.3, 0.6), r)}};
}

Piece lamp(Dice& dice) {
  const double h = dice.between(1.3, 1.6);
  return {"lamp",
          0.18,
          0.18,
          {cylinder(0, 0, -kReach_m, 0.04, 0.15), cylinder(0, 0, 0.03, h, 0.025),
           cylinder(0, 0, h - 0.02, h + 0.25, 0.18)}};
}

Piece cupboard(Dice& dice) {
  Piece p{"cupboard", dice.between(0.4, 0.6), dice.between(0.22, 0.28), {}};
  p.solids.push_back(box(0, 0, -kReach_m, dice.between(1.5, 1.9), p.half_x_m, p.half_y_m));
  return p;
}

Piece chest(Dice& dice) {
  Piece p{"chest", dice.between(0.35, 0.6), dice.between(0.2, 0.25), {}};
  p.solids.push_back(box(0, 0, -kReach_m, dice.between(0.6, 0.9), p.half_x_m, p.half_y_m));
  return p;
}

Piece shelf(Dice& dice) {
  Piece p{"shelf", dice.between(0.4, 0.55), 0.16, {}};
  constexpr double kBoard_m = 0.03;
  constexpr int kBoards = 5;
  const double h = dice.between(1.4, 1.8);
  for (const int side : {-1, 1})
    p.solids.push_back(
        box(side * (p.half_x_m - kBoard_m / 2.0), 0, -kReach_m, h, kBoard_m / 2.0, p.half_y_m));
  for (int k = 0; k < kBoards; ++k) {
    const double z = 0.05 + (h - 0.05 - kBoard_m) * k / (kBoards - 1);
    p.solids.push_back(box(0, 0, z, z + kBoard_m, p.half_x_m, p.half_y_m));
  }
  return p;
}

Piece sofa(Dice& dice) {
  Piece p{"sofa", dice.between(0.75, 0.95), 0.42, {}};
  p.solids.push_back(box(0, 0, -kReach_m, dice.between(0.4, 0.46), p.half_x_m, p.half_y_m));
  p.solids.push_back(box(0, -0.3, -kReach_m, 0.82, p.half_x_m, 0.12));
  for (const int side : {-1, 1})
    p.solids.push_back(box(side * (p.half_x_m - 0.09), 0, -kReach_m, 0.6, 0.09, p.half_y_m));
  return p;
}

constexpr std::array<Piece (*)(Dice&), 4> kAtWalls{cupboard, chest, shelf, sofa};
constexpr std::array<Piece (*)(Dice&), 4> kFree{chair, stool, bin, lamp};

Piece small_thing(Dice& dice, double on_m) {
  const double low = on_m - kReach_m;
  switch (dice.below(4)) {
    case 0:
      return {"cup", 0.04, 0.04, {cylinder(0, 0, low, on_m + dice.between(0.08, 0.12), 0.04)}};
    case 1:
      return {"bowl", 0.1, 0.1, {cylinder(0, 0, low, on_m + dice.between(0.06, 0.09), 0.1)}};
    case 2:
      return {"book", 0.11, 0.08, {box(0, 0, low, on_m + dice.between(0.02, 0.05), 0.11, 0.08)}};
    default:
      return {"parcel", 0.13, 0.1, {box(0, 0, low, on_m + dice.between(0.1, 0.2), 0.13, 0.1)}};
  }
}

/// Where a piece stands: the middle of its footprint, and the angle of its x axis.
struct Stand {
  double x_m = 0.0, y_m = 0.0, turn_rad = 0.0;

  Vec3 of(Vec3 p) const {
    return {x_m + std::cos(turn_rad) * p.x - std::sin(turn_rad) * p.y,
            y_m + std::sin(turn_rad) * p.x + std::cos(turn_rad) * p.y, p.z};
  }
};

std::vector<Solid> placed(const Piece& piece, const Stand& stand) {
  std::vector<Solid> solids = piece.solids;
  for (Solid& s : solids) s.centre_m = stand.of(s.centre_m), s.turn_rad = stand.turn_rad;
  return solids;
}

class Furnisher {
 public:
  Furnisher(Room& room, std::uint64_t seed) : room_(room), dice_(seed) {}

  void furnish() {
    room_.size_m = {dice_.between(4.4, 6.5), dice_.between(4.0, 5.5), dice_.between(2.3, 2.7)};
    room_.floor = finish(120, 180);
    room_.walls = finish(170, 230);
    room_.ceiling = finish(200, 240);
    for (int k = 1 + dice_.below(2); k > 0; --k) add_table();
    for (int k = 3 + dice_.below(3); k > 0; --k)
      add_at_wall(kAtWalls.at(dice_.below(kAtWalls.size()))(dice_));
    for (int k = 2 + dice_.below(3); k > 0; --k) add_free(kFree.at(dice_.below(kFree.size()))(dice_));
  }

 private:
  static constexpr int kTries = 200;

  Finish finish(double dark, double bright) {
    const auto channel = [&] { return static_cast<std::uint8_t>(dice_.between(dark, bright)); };
    Finish f;
    f.colour = {channel(), channel(), channel()};
    f.pattern = static_cast<Pattern>(dice_.below(3));
    f.pattern_m = dice_.between(0.05, 0.3);
    return f;
  }

  void add(const Piece& piece, const Stand& stand) {
    int same = 1;
    for (const Furniture& f : room_.furniture)
      if (f.name == piece.name || f.name.starts_with(piece.name + ' ')) ++same;
    room_.furniture.push_back({same == 1 ? piece.name : piece.name + ' ' + std::to_string(same),
                               finish(40, 230), placed(piece, stand)});
  }

  /// Whether a piece stands at least kClearance_m from all furniture (and walls, unless it is at one).
  bool is_clear(const Piece& piece, const Stand& stand, bool at_wall) const {
    Room around = room_;
    // Walls that are out of reach do not count.
    if (at_wall) around.size_m = {100.0, 100.0, room_.size_m.z};
    constexpr double kStep_m = 0.08;
    const int nx = static_cast<int>(std::ceil(2.0 * piece.half_x_m / kStep_m));
    const int ny = static_cast<int>(std::ceil(2.0 * piece.half_y_m / kStep_m));
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) {
        const Vec3 p =
            stand.of({piece.half_x_m * (2.0 * i / nx - 1.0), piece.half_y_m * (2.0 * j / ny - 1.0), 0.0});
        if (touches(around, {p.x, p.y, kClearance_m})) return false;
      }
    return true;
  }

  bool add_free(const Piece& piece) {
    for (int k = 0; k < kTries; ++k) {
      const Stand stand{room_.size_m.x * dice_.between(-0.5, 0.5), room_.size_m.y * dice_.between(-0.5, 0.5),
                        dice_.between(0.0, 2.0 * std::numbers::pi)};
      if (!is_clear(piece, stand, false)) continue;
      add(piece, stand);
      return true;
    }
    return false;
  }

  void add_at_wall(const Piece& piece) {
    for (int k = 0; k < kTries; ++k) {
      const int wall = dice_.below(4);
      const bool across = wall % 2 == 1;
      const double half_along = (across ? room_.size_m.y : room_.size_m.x) / 2.0;
      const double from_middle = (across ? room_.size_m.x : room_.size_m.y) / 2.0 - piece.half_y_m + kReach_m;
      const double along = dice_.between(-1.0, 1.0) * (half_along - piece.half_x_m);
      // The back (-y) of wall 0's pieces is at the wall y < 0; each further wall is a quarter turn on.
      const double turn = wall * std::numbers::pi / 2.0;
      const Stand stand{std::cos(turn) * along + std::sin(turn) * from_middle,
                        std::sin(turn) * along - std::cos(turn) * from_middle, turn};
      if (!is_clear(piece, stand, true)) continue;
      return add(piece, stand);
    }
  }

  void add_table() {
    const Piece board = table(dice_);
    if (!add_free(board)) return;
    const Furniture placed_table = room_.furniture.back();
    const Solid top = placed_table.solids.front();
    const Stand on{top.centre_m.x, top.centre_m.y, top.turn_rad};
    // One thing on either half of the table at most.
    for (const int side : {-1, 1}) {
      if (dice_.between(0.0, 1.0) < 0.25) continue;
      const Piece thing = small_thing(dice_, top.centre_m.z + top.half_m.z);
      const Vec3 at = on.of({side * dice_.between(0.18, board.half_x_m - 0.18),
                             dice_.between(-1.0, 1.0) * (board.half_y_m - 0.18), 0.0});
      add(thing, {at.x, at.y, dice_.between(0.0, 2.0 * std::numbers::pi)});
    }
  }

  Room& room_;
  Dice dice_;
};

}  // namespace

Room make_room(std::uint64_t seed) {
  Room room;
  Furnisher(room, seed).furnish();
  return room;
}

}  // namespace palpable::study
