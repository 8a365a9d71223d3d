// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "stereo_scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scene_pictures.hpp"
#include "scene_surfaces.hpp"

namespace palpable::bench {
namespace {

Colour random_colour(Random& random, double least, double most) {
  const double level = random.between(least, most);
  Colour out{};
  for (double& c : out) c = std::clamp(level + random.between(-0.12, 0.12), 0.0, 1.0);
  return out;
}

Texture rough(Random& random) {
  return {Pattern::rough, random_colour(random, 0.25, 0.75), random.between(0.15, 0.5),
          random.between(2.0, 9.0), random.next()};
}

Surface wall(Random& random, double disparity_px) {
  Surface s;
  s.x0 = kSceneWidth / 2.0;
  s.y0 = kSceneHeight / 2.0;
  s.d0 = disparity_px;
  s.slope_x = random.between(-0.012, 0.012);
  s.slope_y = random.between(-0.005, 0.01);
  s.texture = rough(random);
  return s;
}

/// A floor that begins at a row of the picture and gets nearer towards its bottom.
Surface floor_from(Random& random, double row, double disparity_px, double slope) {
  Surface s;
  s.y0 = row;
  s.d0 = disparity_px;
  s.slope_y = slope;
  s.outline = {Outline::Shape::rectangle, kSceneWidth / 2.0, row + 200.0, 400.0, 200.0};
  s.texture = rough(random);
  return s;
}

Surface board(Random& random, double disparity_px, double half_size_px, double slope) {
  Surface s;
  s.x0 = random.between(30.0, kSceneWidth - 20.0);
  s.y0 = random.between(25.0, kSceneHeight - 25.0);
  s.d0 = disparity_px;
  s.slope_x = random.between(-slope, slope);
  s.slope_y = random.between(-slope, slope);
  s.outline.shape = random.unit() < 0.5 ? Outline::Shape::rectangle : Outline::Shape::ellipse;
  s.outline.x = s.x0;
  s.outline.y = s.y0;
  s.outline.half_width = random.between(0.6, 1.0) * half_size_px;
  s.outline.half_height = random.between(0.6, 1.2) * half_size_px;
  s.outline = s.outline.turned(random.between(-1.5, 1.5));
  s.texture = rough(random);
  return s;
}

/// A room with some boards: the basis of every kind of scene.
std::vector<Surface> room(Random& random, int boards, double slope) {
  const double far = random.between(4.0, 9.0);
  std::vector<Surface> out{wall(random, far),
                           floor_from(random, random.between(140.0, 190.0), far, random.between(0.08, 0.3))};
  for (int i = 0; i < boards; ++i)
    out.push_back(board(random, random.between(far + 4.0, 36.0), random.between(14.0, 45.0), slope));
  return out;
}

void add_curved(Random& random, std::vector<Surface>& out) {
  for (int i = 0; i < 5; ++i) {
    Surface s = board(random, random.between(14.0, 34.0), 20.0, 0.0);
    s.form = i % 2 == 0 ? Surface::Form::ball : Surface::Form::cylinder;
    s.radius_px = random.between(18.0, 60.0);
    s.outline = {};
    if (s.form == Surface::Form::cylinder)
      s.outline = {Outline::Shape::rectangle, s.x0, s.y0, 400.0, random.between(30.0, 90.0)};
    out.push_back(s);
  }
}

void add_rods(Random& random, std::vector<Surface>& out) {
  for (int i = 0; i < 14; ++i) {
    Surface s = board(random, random.between(14.0, 40.0), 10.0, 0.02);
    s.outline.shape = Outline::Shape::rectangle;
    s.outline.half_width = random.between(0.8, 2.6);
    s.outline.half_height = random.between(40.0, 120.0);
    s.outline = s.outline.turned(random.between(-1.45, 1.45));
    s.texture.contrast *= 0.4;
    out.push_back(s);
  }
}

/// Everything dark and nearly of one colour, with little texture.
void darken(Random& random, std::vector<Surface>& out) {
  const Colour common = random_colour(random, 0.05, 0.12);
  for (Surface& s : out) {
    for (std::size_t c = 0; c < 3; ++c)
      s.texture.colour[c] = std::clamp(common[c] + random.between(-0.025, 0.025), 0.02, 1.0);
    s.texture.contrast = random.between(0.03, 0.1);
  }
}

void repeat_patterns(Random& random, std::vector<Surface>& out) {
  constexpr std::array kPatterns{Pattern::text, Pattern::tiles, Pattern::stripes};
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (i != 0 && random.unit() < 0.25) continue;
    out[i].texture.pattern = kPatterns[static_cast<std::size_t>(random.count(0, 2))];
    out[i].texture.scale_px = random.between(6.0, 16.0);
    out[i].texture.contrast = random.between(0.2, 0.5);
  }
}

void add_leaves(Random& random, std::vector<Surface>& out) {
  const double middle = random.between(16.0, 28.0);
  for (int i = 0; i < 220; ++i) {
    Surface s = board(random, middle + random.between(-8.0, 8.0), 10.0, 0.25);
    s.outline.shape = Outline::Shape::ellipse;
    s.outline.half_width = random.between(2.0, 5.0);
    s.outline.half_height = random.between(5.0, 14.0);
    const double green = random.between(0.25, 0.6);
    s.texture.colour = {0.6 * green, green, 0.35 * green};
    s.texture.contrast = 0.15;
    out.push_back(s);
  }
}

/// A fence: near pickets with strips of the far wall between them, many of which are occluded in one picture.
void add_fence(Random& random, std::vector<Surface>& out) {
  const double disparity_px = random.between(24.0, 40.0), slope = random.between(-0.03, 0.03);
  Texture texture = rough(random);
  double x = random.between(0.0, 15.0);
  while (x < kSceneWidth + 10.0) {
    Surface s;
    const double half = random.between(4.0, 12.0);
    s.x0 = kSceneWidth / 2.0;
    s.y0 = kSceneHeight / 2.0;
    s.d0 = disparity_px;
    s.slope_x = slope;
    s.outline = {Outline::Shape::rectangle, x, random.between(90.0, 150.0), half,
                 random.between(80.0, 110.0)};
    s.texture = texture;
    out.push_back(s);
    x += 2.0 * half + random.between(8.0, 38.0);
  }
}

/// Bright boards 1 to 4 px before a wall so dark and plain that its texture is hardly above the noise.
std::vector<Surface> boards_before_dark_wall(Random& random) {
  const double far = random.between(3.0, 8.0);
  std::vector<Surface> out{wall(random, far)};
  out[0].texture.colour = random_colour(random, 0.06, 0.25);
  out[0].texture.contrast = random.between(0.05, 0.15);
  out[0].texture.scale_px = random.between(6.0, 30.0);
  for (int i = random.count(3, 5); i > 0; --i) {
    Surface s = board(random, far + random.between(1.4, 4.0), random.between(30.0, 80.0), 0.02);
    s.outline.shape = Outline::Shape::rectangle;
    s.texture.colour = random_colour(random, 0.4, 0.8);
    if (random.unit() < 0.25) s.texture.contrast = random.between(0.02, 0.08);
    out.push_back(s);
  }
  return out;
}

/// An upright rectangle that faces the camera.
Surface panel(double x, double y, double half_width, double half_height, double disparity_px,
              const Texture& texture) {
  Surface s;
  s.x0 = x;
  s.y0 = y;
  s.d0 = disparity_px;
  s.outline = {Outline::Shape::rectangle, x, y, half_width, half_height};
  s.texture = texture;
  return s;
}

/// A room of a few layers, less than 16 px deep: dark shelves with spines of books, a table, its legs, thin
/// rods and objects of one colour in front.
std::vector<Surface> interior(Random& random) {
  const double far = random.between(3.0, 6.0), step = random.between(0.8, 1.6);
  std::vector<Surface> out{wall(random, far)};
  out[0].slope_x = out[0].slope_y = 0.0;
  out[0].texture.colour = random_colour(random, 0.05, 0.2);
  out[0].texture.contrast = random.between(0.02, 0.15);
  const auto dark = [&] {
    return Texture{Pattern::rough, random_colour(random, 0.04, 0.2), random.between(0.02, 0.12),
                   random.between(2.0, 9.0), random.next()};
  };
  const double shelf_height = random.between(36.0, 60.0), shelf_width = random.between(70.0, 120.0);
  for (double y = random.between(0.0, 20.0); y < kSceneHeight; y += shelf_height) {
    out.push_back(panel(kSceneWidth / 2.0, y, kSceneWidth, random.between(1.5, 3.5), far + step, dark()));
    for (double x = random.between(0.0, 10.0); x < kSceneWidth; x += random.between(5.0, 14.0)) {
      if (random.unit() < 0.35) continue;
      Texture book = random.unit() < 0.4 ? dark() : rough(random);
      if (random.unit() < 0.3) book.contrast = 0.04;
      const double half = random.between(2.0, 6.0), tall = random.between(0.3, 0.46) * shelf_height;
      out.push_back(
          panel(x, y + shelf_height - 3.0 - tall, half, tall, far + random.between(0.2, 0.9) * step, book));
    }
  }
  for (double x = random.between(0.0, 40.0); x < kSceneWidth; x += shelf_width)
    out.push_back(panel(x, kSceneHeight / 2.0, random.between(1.5, 4.0), kSceneHeight, far + step, dark()));
  const double table = far + random.between(2.0, 4.5), top = random.between(150.0, 190.0);
  const double x0 = random.between(120.0, 220.0), half = random.between(50.0, 90.0);
  out.push_back(panel(x0, top, half, random.between(8.0, 18.0), table, rough(random)));
  for (const double side : {-1.0, 1.0})
    out.push_back(
        panel(x0 + side * (half - 9.0), top + 60.0, random.between(5.0, 10.0), 60.0, table, dark()));
  for (int i = random.count(4, 7); i > 0; --i) {
    Surface s = board(random, far + random.between(2.0, 11.0), random.between(10.0, 34.0), 0.03);
    if (random.unit() < 0.5) s.texture = dark();
    if (random.unit() < 0.4) s.texture.contrast = random.between(0.02, 0.1);
    out.push_back(s);
  }
  for (int i = random.count(2, 6); i > 0; --i) {
    Surface s = board(random, far + random.between(2.0, 11.0), 10.0, 0.01);
    s.outline.shape = Outline::Shape::rectangle;
    s.outline.half_width = random.between(0.8, 2.5);
    s.outline.half_height = random.between(20.0, 70.0);
    s.outline = s.outline.turned(random.between(-1.5, 1.5));
    if (random.unit() < 0.5) s.texture = dark();
    out.push_back(s);
  }
  return out;
}

/// Nothing to match by: every surface has the one colour.
void blank_out(Random& random, std::vector<Surface>& out) {
  const Colour common = random_colour(random, 0.1, 0.9);
  for (Surface& s : out) s.texture = {Pattern::plain, common, 0.0, 4.0, 1};
}

/// Large boards of one colour each, far before a textured room: only their outlines can be matched.
void add_plain_boards(Random& random, std::vector<Surface>& out) {
  out.resize(2);
  for (int i = random.count(1, 3); i > 0; --i) {
    Surface s = board(random, random.between(14.0, 60.0), random.between(35.0, 90.0), 0.0);
    s.texture = {Pattern::plain, random_colour(random, 0.1, 0.9), random.between(0.0, 0.02), 4.0,
                 random.next()};
    out.push_back(s);
  }
}

/// Dark, with a texture of the size of the noise, in small steps of depth.
std::vector<Surface> faint_boards(Random& random) {
  const double far = random.between(4.0, 9.0);
  std::vector<Surface> out{wall(random, far)};
  for (int i = random.count(2, 5); i > 0; --i)
    out.push_back(board(random, far + random.between(1.5, 8.0), random.between(20.0, 70.0), 0.02));
  const Colour common = random_colour(random, 0.05, 0.15);
  for (Surface& s : out) {
    s.texture.colour = common;
    s.texture.contrast = random.between(0.01, 0.05);
  }
  return out;
}

Description describe(SceneKind kind, Random& random) {
  Description out;
  std::vector<Surface>& s = out.surfaces;
  s = room(random, random.count(4, 7), kind == SceneKind::slanted ? 0.35 : 0.06);
  switch (kind) {
    case SceneKind::slanted:
      s[0].slope_x = random.between(-0.05, 0.05);
      s[0].d0 += std::abs(s[0].slope_x) * kSceneWidth / 2.0;
      break;
    case SceneKind::curved:
      add_curved(random, s);
      break;
    case SceneKind::rods:
      add_rods(random, s);
      break;
    case SceneKind::dark_edges:
      darken(random, s);
      break;
    case SceneKind::repeated:
      repeat_patterns(random, s);
      break;
    case SceneKind::plain:
      for (Surface& surface : s)
        if (random.unit() < 0.75) surface.texture.pattern = Pattern::plain;
      break;
    case SceneKind::foliage:
      add_leaves(random, s);
      break;
    case SceneKind::hidden:
      add_fence(random, s);
      break;
    case SceneKind::exposure:
      out.degradation.gain = random.between(0.45, 0.8);
      out.degradation.offset = random.between(-0.03, 0.06);
      out.degradation.gamma = random.between(0.85, 1.2);
      break;
    case SceneKind::noise:
      out.degradation.noise = random.between(4.0, 10.0) / 255.0;
      break;
    case SceneKind::vertical:
      out.degradation.lower_px = random.unit() < 0.5 ? 0.5 : -0.5;
      out.degradation.roll_px = random.between(-0.3, 0.3);
      break;
    case SceneKind::sharpened:
      s = boards_before_dark_wall(random);
      out.degradation.sharpening = random.between(0.3, 1.2);
      break;
    case SceneKind::interior:
      s = interior(random);
      out.degradation.sharpening = random.between(0.0, 0.8);
      break;
    case SceneKind::blank:
      blank_out(random, s);
      out.degradation.noise = random.unit() < 0.4 ? 0.0 : random.between(0.5, 5.0) / 255.0;
      break;
    case SceneKind::plain_boards:
      add_plain_boards(random, s);
      out.degradation.noise = random.between(0.0, 4.0) / 255.0;
      break;
    case SceneKind::faint:
      s = faint_boards(random);
      out.degradation.noise = random.between(0.5, 2.0) / 255.0;
      break;
    case SceneKind::unrelated:
      break;
  }
  return out;
}

/// The seeds `first` … `last` of the first kinds.
std::vector<StereoScene> scenes_of(int kinds, int first, int last) {
  std::vector<StereoScene> out;
  for (int kind = 0; kind < kinds; ++kind)
    for (int seed = first; seed <= last; ++seed)
      out.push_back(render_scene(static_cast<SceneKind>(kind), static_cast<std::uint32_t>(seed)));
  return out;
}

}  // namespace

std::string_view name_of(SceneKind kind) {
  constexpr std::array<std::string_view, kAllSceneKinds> kNames{
      "slanted",  "curved", "rods",         "dark-edges", "repeated", "plain",
      "foliage",  "hidden", "exposure",     "noise",      "vertical", "sharpened",
      "interior", "blank",  "plain-boards", "faint",      "unrelated"};
  return kNames[static_cast<std::size_t>(kind)];
}

StereoScene render_scene(SceneKind kind, std::uint32_t seed) {
  Random random(static_cast<std::uint64_t>(kind) * 1000U + seed);
  const Description description = describe(kind, random);
  const Description elsewhere = kind == SceneKind::unrelated ? describe(kind, random) : description;
  StereoScene out{std::string(name_of(kind)) + "-" + std::to_string(seed),
                  kind,
                  {picture_of(description, 0.0, 2 * random.next()),
                   picture_of(elsewhere, 1.0, 2 * random.next() + 1),
                   {}},
                  Raster<float>(kSceneWidth, kSceneHeight),
                  Raster<std::uint8_t>(kSceneWidth, kSceneHeight)};
  for (int y = 0; y < kSceneHeight; ++y)
    for (int x = 0; x < kSceneWidth; ++x) {
      const Hit hit = first_hit(description.surfaces, 0.0, x, y);
      out.truth_px(x, y) = static_cast<float>(hit.disparity_px);
      const double there = x - hit.disparity_px;
      if (there < 0.0) continue;
      const Hit seen = first_hit(description.surfaces, 1.0, there, y);
      out.seen_by_both(x, y) =
          seen.surface == hit.surface && std::abs(seen.disparity_px - hit.disparity_px) < 1e-6 ? 1 : 0;
    }
  return out;
}

std::vector<StereoScene> tuning_set(int seeds_per_kind) { return scenes_of(kSceneKinds, 1, seeds_per_kind); }
std::vector<StereoScene> confidence_set(int first, int last) {
  return scenes_of(kAllSceneKinds, first, last);
}

}  // namespace palpable::bench
