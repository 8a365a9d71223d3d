// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/video/video_report.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/draw/canvas/colour_map.hpp"
#include "palpable/draw/view/camera_path_view.hpp"
#include "palpable/draw/view/convergence_view.hpp"
#include "palpable/draw/view/height_view.hpp"
#include "palpable/draw/view/report_page.hpp"
#include "palpable/draw/view/solid_view.hpp"
#include "palpable/formats/picture/png.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

using recipes::VideoReconstruction;

constexpr double kMillimetres = 1000.0;

// Indices of `wanted` of `count` values, evenly spaced.
std::vector<std::size_t> spaced(std::size_t count, std::size_t wanted) {
  std::vector<std::size_t> out;
  const std::size_t taken = std::min(count, wanted);
  for (std::size_t i = 0; i < taken; ++i) out.push_back(taken > 1 ? i * (count - 1) / (taken - 1) : 0);
  return out;
}

Result<void> add_picture(const draw::Figure& figure, std::string alternative, std::string caption,
                         draw::ReportSection& to) {
  auto png = draw::png_of(figure);
  if (!png) return png.error();
  to.pictures.push_back({std::move(*png), std::move(alternative), std::move(caption)});
  return {};
}

Result<void> add_picture(const Raster<Rgb8>& picture, std::string alternative, std::string caption,
                         draw::ReportSection& to) {
  auto png = formats::encode_png(picture);
  if (!png) return png.error();
  to.pictures.push_back({std::move(*png), std::move(alternative), std::move(caption)});
  return {};
}

// A frame, and its depth at the right of it: near is pale, far is dark, unknown is grey.
Raster<Rgb8> picture_and_depth(const VideoReconstruction::Depth& depth) {
  const Raster<float>& z = depth.map.depth_m;
  std::vector<double> known;
  for (const float value : z.values())
    if (value > 0) known.push_back(static_cast<double>(value));
  const double near = known.empty() ? 0.0 : quantile_of(known, 0.01),
               far = known.empty() ? 1.0 : std::max(quantile_of(known, 0.99), near * 1.0001);
  Raster<Rgb8> out(2 * z.width(), z.height());
  for (int y = 0; y < z.height(); ++y)
    for (int x = 0; x < z.width(); ++x) {
      out(x, y) = depth.picture(x, y);
      constexpr Rgb8 kUnknown{150, 150, 150};
      out(z.width() + x, y) =
          z(x, y) > 0 ? draw::depth_colour((far - static_cast<double>(z(x, y))) / (far - near)) : kUnknown;
    }
  return out;
}

draw::ReportSection advice_section(const VideoReconstruction& video) {
  draw::ReportSection out{"What to do better", {}, {}, {}, {}, {}};
  for (const Note& note : video.advice) out.items.push_back(note.sentence);
  if (out.items.empty())
    out.paragraphs.emplace_back(
        "Nothing: the video shows the model from all sides, sharp and in good light.");
  return out;
}

Result<draw::ReportSection> frames_section(const VideoReconstruction& video) {
  draw::ReportSection out{
      "The video and the measured distances",
      {"On the left a picture of the video, on the right how far each place was from the camera: "
       "pale is near, dark is far, grey could not be measured."},
      {},
      {},
      {},
      {}};
  for (const std::size_t i : spaced(video.depth_maps.size(), 4)) {
    const auto& depth = video.depth_maps[i];
    const auto values = depth.map.depth_m.values();
    const auto known = std::count_if(values.begin(), values.end(), [](float z) { return z > 0; });
    const double percent = 100.0 * static_cast<double>(known) / static_cast<double>(values.size());
    const std::string caption =
        fmt::format("Picture {} of the video; {:.0f} % of it was measured.", depth.frame_number, percent);
    if (auto added =
            add_picture(picture_and_depth(depth),
                        fmt::format("Picture {} of the video, and a map of its distances from the camera.",
                                    depth.frame_number),
                        caption, out);
        !added)
      return added.error();
  }
  return out;
}

Result<draw::ReportSection> path_section(const VideoReconstruction& video) {
  draw::ReportSection out{"The camera's path", {}, {}, {}, {}, {}};
  draw::CameraPathView view;
  view.unit = "mm";
  double length = 0.0;
  for (const auto& pose : video.poses) {
    view.cameras.push_back(
        kMillimetres * (video.scene_from_world * Point<WorldFrame>{pose.world_from_camera.translation_m}).v);
    if (view.cameras.size() > 1) length += norm(view.cameras.back() - view.cameras[view.cameras.size() - 2]);
  }
  for (const std::size_t i : spaced(video.structure.places_m.size(), 6000))
    view.points.push_back(kMillimetres *
                          (video.scene_from_world * Point<WorldFrame>{video.structure.places_m[i]}).v);
  const std::string scale = video.metric ? "" : " of the touched model, whose true size is not known";
  out.paragraphs.push_back(fmt::format("The camera was found in {} of {} pictures. It moved {:.0f} mm{}.",
                                       video.figures.posed, video.figures.tried, length, scale));
  if (auto added = add_picture(
          draw::camera_path_figure(std::move(view),
                                   {"The camera's path", "Orange: the camera; grey: measured points"}),
          fmt::format("Two plots of the camera's path around the measured points, from above and from "
                      "the front; the path is {:.0f} mm long.",
                      length),
          "The path from above (left) and from the front (right).", out);
      !added)
    return added.error();
  return out;
}

Result<draw::ReportSection> model_section(const models::Scene& scene) {
  draw::ReportSection out{"The model that is touched", {}, {}, {}, {}, {}};
  const Vec3 size = models::size_m(scene);
  const std::string extent = fmt::format("{:.0f} x {:.0f} x {:.0f} mm", kMillimetres * size.x,
                                         kMillimetres * size.y, kMillimetres * size.z);
  out.paragraphs.push_back("Its size is " + extent + " (wide, deep, high).");
  if (auto added =
          add_picture(draw::relief_figure(*models::relief_of(scene), {"The model from above", extent}),
                      fmt::format("The model from above, {} in size; colours show the height.", extent),
                      "The model from above.", out);
      !added)
    return added.error();
  // It lies on the ground, z up and y to the back.
  constexpr draw::SolidViewOptions kFromTheFront{15.0, -35.0, 12.0};
  const draw::FigureTitle title{"The model", "from the front, above; " + extent};
  const auto figure = [&]() -> std::optional<draw::Figure> {
    if (const auto* field = std::get_if<std::shared_ptr<const models::Field>>(&scene.model))
      return draw::solid_figure(*field, kFromTheFront, title);
    if (const auto* field = std::get_if<std::shared_ptr<const models::FieldOnLattice>>(&scene.model))
      return draw::solid_figure(*field, kFromTheFront, title);
    return std::nullopt;
  }();
  if (figure)
    if (auto added =
            add_picture(*figure, fmt::format("The model, {} in size, from the front and above.", extent),
                        "The model from the front and above.", out);
        !added)
      return added.error();
  return out;
}

// Where the true size is not known: a picture in which two places of a known distance are clicked.
Result<draw::ReportSection> size_section(const VideoReconstruction& video) {
  draw::ReportSection out{
      "The true size",
      {"The video does not show how large the model is. If you know a distance on it: click its two ends "
       "in the picture, type the distance, and repeat the command with the words below."},
      {},
      {},
      {},
      {}};
  const auto& middle = video.depth_maps[video.depth_maps.size() / 2];
  auto png = formats::encode_png(middle.picture);
  if (!png) return png.error();
  const std::string name = fmt::format("Picture {} of the video.", middle.frame_number);
  out.length = draw::ReportLength{{std::move(*png), name, name}, middle.frame_number, 1.0 / video.reduction};
  return out;
}

// The error of the superquadrics alone, before they were sampled, beside that of the result.
std::string errors_sentence(const std::vector<VideoReconstruction::Step>& steps) {
  double shapes_m = 0.0, corrected_m = 0.0;
  for (const auto& step : steps) {
    if (!step.taken) continue;
    (step.kind < recipes::ModelStep::Kind::sampling ? shapes_m : corrected_m) = step.error_m;
  }
  const std::string alone = fmt::format(
      "Mean distance of the measured points from the surface: {:.2f} mm for the superquadrics alone",
      kMillimetres * shapes_m);
  return corrected_m <= shapes_m
             ? fmt::format("{}, {:.2f} mm after the correction.", alone, kMillimetres * corrected_m)
             : fmt::format("{}; their correction was not closer ({:.2f} mm), so they were kept.", alone,
                           kMillimetres * corrected_m);
}

Result<draw::ReportSection> steps_section(const VideoReconstruction& video) {
  draw::ReportSection out{"How the model grew",
                          {"The first shapes follow from the outlines in one picture alone. Superquadrics, "
                           "which are simple round or "
                           "angular bodies, were then fitted to the points that more and more pictures "
                           "showed, and their surface was "
                           "corrected by the measured distances of one picture after the other."},
                          {},
                          {},
                          {},
                          {}};
  draw::ConvergenceView view{{"first shapes, from one picture", "superquadrics, from the points",
                              "their surface as samples", "correction"},
                             {}};
  for (const auto& step : video.steps)
    view.steps.push_back({static_cast<std::size_t>(step.kind), kMillimetres * step.error_m, step.taken});
  const std::string caption = errors_sentence(video.steps);
  if (auto added = add_picture(draw::convergence_figure(std::move(view), {"Error after each step", ""}),
                               caption, caption, out);
      !added)
    return added.error();
  return out;
}

draw::ReportSection figures_section(const VideoReconstruction& video, const std::vector<Note>& notes) {
  const recipes::VideoFigures& f = video.figures;
  draw::ReportSection out{"Figures and notes", {}, {}, {}, {}, {}};
  for (const Note& note : notes) out.items.push_back(note.sentence);
  const auto yes = [](bool seen) { return std::string(seen ? "yes" : "no"); };
  out.table = draw::ReportTable{
      "Figures of the video",
      {"what", "value"},
      {{"pictures read", fmt::format("{}", f.frames)},
       {"blurred pictures, left out", fmt::format("{}", f.blurred)},
       {"blurred pictures among blurred ones, used", fmt::format("{}", f.soft)},
       {"width of the sharpest edges", fmt::format("{:.1f} px", f.edge_width_px)},
       {"pictures like the one before, left out", fmt::format("{}", f.copies)},
       {"pictures whose camera position was found", fmt::format("{} of {}", f.posed, f.tried)},
       {"points that could be followed (median)", fmt::format("{:.0f}", f.followed_points)},
       {"points that moved by themselves", fmt::format("{:.1f} %", 100 * f.moving_points)},
       {"largest area that something covered in one picture", fmt::format("{:.1f} %", 100 * f.covered)},
       {"error of followed points (root mean square)", fmt::format("{:.2f} px", f.reprojection_rms_px)},
       {"pixels whose distance was measured", fmt::format("{:.0f} %", 100 * f.known_depth)},
       {"focal length", fmt::format("{:.0f} px", video.camera.fx)},
       {"true size known", yes(video.metric)},
       {"left side seen", yes(f.left_seen)},
       {"right side seen", yes(f.right_seen)},
       {"front seen", yes(f.front_seen)},
       {"back seen", yes(f.back_seen)}}};
  return out;
}

}  // namespace

Result<std::string> video_report(const std::string& name, const VideoReconstruction& video,
                                 const models::Scene& scene, const std::vector<Note>& notes) {
  draw::ReportPage page{
      "A touchable model from " + name,
      "This page shows how the video became a model, step by step, and what would make it better.",
      {}};
  page.sections.push_back(advice_section(video));
  for (auto section : {model_section(scene), frames_section(video), path_section(video)}) {
    if (!section) return section.error();
    page.sections.push_back(std::move(*section));
  }
  if (!video.steps.empty()) {
    auto section = steps_section(video);
    if (!section) return section.error();
    page.sections.push_back(std::move(*section));
  }
  if (!video.metric && !video.depth_maps.empty()) {
    auto section = size_section(video);
    if (!section) return section.error();
    page.sections.push_back(std::move(*section));
  }
  page.sections.push_back(figures_section(video, notes));
  return draw::html_of(page);
}

}  // namespace palpable::cli
