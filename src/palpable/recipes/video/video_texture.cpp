// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/video_texture.hpp"

#include "palpable/recipes/video/seen_vertices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace palpable::recipes {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
constexpr int kNoFrame = -1;

// The vertices as each frame shows them.
using Views = std::vector<std::vector<SeenVertex>>;

bool shows(const std::vector<SeenVertex>& view, const Triangle& t) {
  return view[t[0]].seen() && view[t[1]].seen() && view[t[2]].seen();
}

double area_px(const std::vector<SeenVertex>& view, const Triangle& t) {
  const SeenVertex &a = view[t[0]], &b = view[t[1]], &c = view[t[2]];
  return 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

// For each triangle the frame in which it is largest.
std::vector<int> largest_views(const Mesh& mesh, const Views& views) {
  std::vector<int> out;
  for (const Triangle& t : mesh.triangles) {
    int best = kNoFrame;
    double largest = 0.0;
    for (std::size_t k = 0; k < views.size(); ++k)
      if (shows(views[k], t) && area_px(views[k], t) > largest)
        largest = area_px(views[k], t), best = static_cast<int>(k);
    out.push_back(best);
  }
  return out;
}

// For each side of each triangle the triangle beyond it; the triangle itself where there is none.
std::vector<std::array<std::size_t, 3>> neighbours_of(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> from_edge;
  std::vector<std::array<std::size_t, 3>> out(mesh.triangles.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) from_edge[{mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3]}] = i;
  for (std::size_t i = 0; i < out.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto beyond = from_edge.find({mesh.triangles[i][(k + 1) % 3], mesh.triangles[i][k]});
      out[i][k] = beyond == from_edge.end() ? i : beyond->second;
    }
  return out;
}

// A triangle takes the frame of two of its neighbours if this frame shows it: fewer and shorter seams.
void join_parts(const Mesh& mesh, const Views& views, std::vector<int>& frames) {
  // Parts of single triangles are gone after few rounds.
  constexpr int kRounds = 4;
  const auto neighbours = neighbours_of(mesh);
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const int a = frames[neighbours[i][0]], b = frames[neighbours[i][1]], c = frames[neighbours[i][2]];
      const int most = a == b || a == c ? a : b == c ? b : kNoFrame;
      if (most != kNoFrame && shows(views[static_cast<std::size_t>(most)], mesh.triangles[i]))
        frames[i] = most;
    }
}

// By how much each channel of a frame is multiplied to agree with the mean of all frames.
std::array<double, 3> gains_of(const std::vector<SeenVertex>& view, const Raster<Rgb8>& picture,
                               const std::vector<Rgb8>& means) {
  std::array<double, 3> here{}, all{};
  for (std::size_t i = 0; i < view.size(); ++i) {
    if (!view[i].seen()) continue;
    const Rgb8 p =
        picture(static_cast<int>(std::lround(view[i].x)), static_cast<int>(std::lround(view[i].y)));
    here[0] += p.r, here[1] += p.g, here[2] += p.b;
    all[0] += means[i].r, all[1] += means[i].g, all[2] += means[i].b;
  }
  // A frame in which hardly anything is seen says little about its brightness.
  constexpr double kLeast = 0.5, kMost = 2.0;
  std::array<double, 3> out{1, 1, 1};
  for (std::size_t c = 0; c < 3; ++c)
    if (here[c] > 0) out[c] = std::clamp(all[c] / here[c], kLeast, kMost);
  return out;
}

Rgb8 multiplied(const Rgb8& colour, const std::array<double, 3>& gains) {
  const auto level = [](double value) {
    return static_cast<std::uint8_t>(std::lround(std::min(255.0, value)));
  };
  return {level(gains[0] * colour.r), level(gains[1] * colour.g), level(gains[2] * colour.b)};
}

// A part of a frame, and where it lies in the texture.
struct Part {
  int left = std::numeric_limits<int>::max(), top = left, right = 0, bottom = 0;
  Pixel at;

  bool empty() const { return right <= left; }
  int width() const { return right - left; }
  int height() const { return bottom - top; }
};

// The parts of the frames that triangles show, with a pixel around them for interpolation.
std::vector<Part> used_parts(const Mesh& mesh, const Views& views, const std::vector<int>& frames,
                             const VideoReconstruction& video) {
  std::vector<Part> out(views.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i] == kNoFrame) continue;
    const auto k = static_cast<std::size_t>(frames[i]);
    const Raster<Rgb8>& picture = video.depth_maps[k].picture;
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      const SeenVertex& v = views[k][vertex];
      Part& part = out[k];
      part.left = std::min(part.left, std::max(0, static_cast<int>(std::floor(v.x)) - 1));
      part.top = std::min(part.top, std::max(0, static_cast<int>(std::floor(v.y)) - 1));
      part.right = std::max(part.right, std::min(picture.width(), static_cast<int>(std::ceil(v.x)) + 2));
      part.bottom = std::max(part.bottom, std::min(picture.height(), static_cast<int>(std::ceil(v.y)) + 2));
    }
  }
  return out;
}

// Places the parts in rows, the highest first, in a texture that is about square; returns its size.
Pixel place_in_rows(std::vector<Part>& parts) {
  // Room for a row of plain colours where no part is used.
  constexpr int kLeastWidth = 96;
  double area = 0.0;
  int width = kLeastWidth;
  for (const Part& part : parts)
    if (!part.empty()) {
      area += static_cast<double>(part.width()) * part.height();
      width = std::max(width, part.width());
    }
  width = std::max(width, static_cast<int>(std::ceil(std::sqrt(area))));
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return parts[a].height() > parts[b].height(); });
  Pixel at;
  int row = 0;
  for (const std::size_t k : order) {
    Part& part = parts[k];
    if (part.empty()) continue;
    if (at.x + part.width() > width) at = {0, at.y + row}, row = 0;
    part.at = at;
    at.x += part.width();
    row = std::max(row, part.height());
  }
  return {width, at.y + row};
}

// Squares of one colour below the frames' parts, for triangles that no frame shows.
class PlainColours {
 public:
  PlainColours(int width, int top) : columns_(std::max(1, width / kSide)), top_(top) {}

  // The middle of the colour's square. Colours differ by at least eight levels, so that there are few.
  Pixel place_of(Rgb8 colour) {
    const auto coarse = [](std::uint8_t level) { return static_cast<std::uint8_t>((level & 0xF8U) | 4U); };
    colour = {coarse(colour.r), coarse(colour.g), coarse(colour.b)};
    const auto [found, is_new] =
        index_.try_emplace(std::array{colour.r, colour.g, colour.b}, static_cast<int>(colours_.size()));
    if (is_new) colours_.push_back(colour);
    return {found->second % columns_ * kSide + kSide / 2,
            top_ + found->second / columns_ * kSide + kSide / 2};
  }
  int height() const { return (static_cast<int>(colours_.size()) + columns_ - 1) / columns_ * kSide; }
  void paint(Raster<Rgb8>& texture) const {
    for (int i = 0; i < static_cast<int>(colours_.size()); ++i)
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
          if (const int u = i % columns_ * kSide + x; u < texture.width())
            texture(u, top_ + i / columns_ * kSide + y) = colours_[static_cast<std::size_t>(i)];
  }

 private:
  // With a pixel of the same colour around the middle.
  static constexpr int kSide = 3;
  int columns_, top_;
  std::map<std::array<std::uint8_t, 3>, int> index_;
  std::vector<Rgb8> colours_;
};

Rgb8 mean_of(const Triangle& t, const std::vector<Rgb8>& colours) {
  const auto level = [&](auto channel) {
    return static_cast<std::uint8_t>(
        (colours[t[0]].*channel + colours[t[1]].*channel + colours[t[2]].*channel) / 3);
  };
  return {level(&Rgb8::r), level(&Rgb8::g), level(&Rgb8::b)};
}

// A vertex and its place in the texture, in sixteenths of a pixel.
using VertexKey = std::array<std::int64_t, 3>;

// Collects triangles whose corners have places in a texture.
class TexturedTriangles {
 public:
  TexturedTriangles(const Mesh& mesh, const std::vector<Vec3>& normals) : mesh_(mesh), normals_(normals) {}

  void add(const Triangle& t, const std::array<std::array<double, 2>, 3>& places_px) {
    Triangle out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = corner(t[k], places_px[k]);
    made_.mesh.triangles.push_back(out);
  }
  TexturedMesh take(Raster<Rgb8> picture) {
    for (const auto& [x, y] : places_px_)
      made_.mesh.picture_places.push_back({static_cast<float>((x + 0.5) / picture.width()),
                                           static_cast<float>((y + 0.5) / picture.height())});
    made_.picture = std::move(picture);
    return std::move(made_);
  }

 private:
  std::uint32_t corner(std::uint32_t vertex, const std::array<double, 2>& place) {
    constexpr double kFiner = 16.0;
    const VertexKey key{vertex, std::llround(kFiner * place[0]), std::llround(kFiner * place[1])};
    const auto [found, is_new] =
        index_.try_emplace(key, static_cast<std::uint32_t>(made_.mesh.vertices_m.size()));
    if (is_new) {
      made_.mesh.vertices_m.push_back(mesh_.vertices_m[vertex]);
      made_.normals.push_back(normals_[vertex]);
      places_px_.push_back(place);
    }
    return found->second;
  }

  const Mesh& mesh_;
  const std::vector<Vec3>& normals_;
  TexturedMesh made_;
  std::vector<std::array<double, 2>> places_px_;
  std::map<VertexKey, std::uint32_t> index_;
};

void copy_part(const Raster<Rgb8>& from, const Part& part, const std::array<double, 3>& gains,
               Raster<Rgb8>& to) {
  for (int y = 0; y < part.height(); ++y)
    for (int x = 0; x < part.width(); ++x)
      to(part.at.x + x, part.at.y + y) = multiplied(from(part.left + x, part.top + y), gains);
}

// Where the corners of a triangle that a frame shows lie in the texture.
std::array<std::array<double, 2>, 3> places_in(const Part& part, const std::vector<SeenVertex>& view,
                                               const Triangle& t) {
  std::array<std::array<double, 2>, 3> out{};
  for (std::size_t c = 0; c < 3; ++c)
    out[c] = {view[t[c]].x - part.left + part.at.x, view[t[c]].y - part.top + part.at.y};
  return out;
}

}  // namespace

TexturedMesh textured(const Mesh& mesh, const VideoReconstruction& video, const VideoColourOptions& options) {
  const std::vector<Vec3> normals = vertex_normals(mesh);
  const std::vector<Rgb8> means = colours_of(mesh, video, options);
  Views views;
  for (const auto& view : video.depth_maps)
    views.push_back(seen_vertices(mesh, normals, video, view, options));
  std::vector<int> frames = largest_views(mesh, views);
  join_parts(mesh, views, frames);
  std::vector<Part> parts = used_parts(mesh, views, frames, video);
  const Pixel size = place_in_rows(parts);
  PlainColours plain(size.x, size.y);
  TexturedTriangles triangles(mesh, normals);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    if (frames[i] == kNoFrame) {
      const Pixel at = plain.place_of(mean_of(t, means));
      const std::array<double, 2> place{static_cast<double>(at.x), static_cast<double>(at.y)};
      triangles.add(t, {place, place, place});
    } else {
      const auto k = static_cast<std::size_t>(frames[i]);
      triangles.add(t, places_in(parts[k], views[k], t));
    }
  }
  Raster<Rgb8> picture(size.x, size.y + plain.height());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Raster<Rgb8>& frame = video.depth_maps[k].picture;
    if (!parts[k].empty()) copy_part(frame, parts[k], gains_of(views[k], frame, means), picture);
  }
  plain.paint(picture);
  return triangles.take(std::move(picture));
}

}  // namespace palpable::recipes
