// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/law_options.hpp"
#include "palpable/cli/arguments/scene_argument.hpp"
#include "palpable/cli/command.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/draw/view/contours_view.hpp"
#include "palpable/draw/view/field_view.hpp"
#include "palpable/draw/view/force_view.hpp"
#include "palpable/draw/view/height_view.hpp"
#include "palpable/draw/view/map_view.hpp"
#include "palpable/draw/view/marks_view.hpp"
#include "palpable/draw/view/section_view.hpp"
#include "palpable/draw/view/solid_view.hpp"
#include "palpable/sculpt/contours/boundary_map_from_picture.hpp"

#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct ShowArguments {
  std::string scene, output;
  std::string view;
  LawArguments law;
  std::optional<double> cut_mm;
  draw::SolidViewOptions solid;
  draw::FieldSectionOptions section;
  bool picture = false;
};

/// "made from A.png and B.png"; only the first of many files; empty if the scene does not state any.
std::string origin_of(const models::Scene& scene) {
  constexpr std::size_t kMostNamed = 3;
  std::vector<std::string> files;
  for (const std::string& input : scene.source.inputs)
    files.push_back(std::filesystem::path(input).filename().string());
  if (files.empty()) return {};
  if (files.size() > kMostNamed)
    return fmt::format(", made from {} and {} more files", files.front(), files.size() - 1);
  return ", made from " + describe::listed(files);
}

draw::FigureTitle title_of(const ShowArguments& arguments, const models::Scene& scene,
                           const std::string& what) {
  const Vec3 size = models::size_m(scene);
  // Contours lie in a plane.
  const std::string height = size.z > 0.0 ? fmt::format(", {} {}", describe::length(size.z),
                                                        models::is_upright_solid(scene) ? "deep" : "high")
                                          : std::string();
  const std::string name =
      scene.title.empty() ? std::filesystem::path(arguments.scene).stem().string() : scene.title;
  return {fmt::format("{}: {}", name, what),
          fmt::format("{} × {} mm{}{}", figure(1000.0 * size.x, 3), figure(1000.0 * size.y, 3), height,
                      origin_of(scene))};
}

/// The forces on a hand that rests at each point of a grid, pressed in by half a millimetre if the law needs
/// contact; a new touch at every point.
std::vector<draw::ForceArrow> forces_on(const models::Relief& relief, const haptics::Touchable& touchable,
                                        double spacing_m) {
  constexpr double kPress_m = 0.0005;
  std::vector<draw::ForceArrow> arrows;
  const int columns = static_cast<int>(relief.size_x_m() / spacing_m),
            rows = static_cast<int>(relief.size_y_m() / spacing_m);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const double x = (i - 0.5 * (columns - 1)) * spacing_m, y = (j - 0.5 * (rows - 1)) * spacing_m;
      haptics::TouchState state;
      haptics::Hand hand;
      hand.position = {{x, y, relief.sample(x, y).z_m}};
      touchable.evaluate(hand, state);
      hand.position.v.z -= kPress_m;
      const haptics::LawOutput output = touchable.evaluate(hand, state);
      arrows.push_back({x, y, output.force_N.v.x, output.force_N.v.y});
    }
  }
  return arrows;
}

Result<draw::Figure> force_picture(const ShowArguments& arguments, const models::Scene& scene,
                                   const models::Relief& relief) {
  constexpr double kArrowsAcross = 28.0;
  LawArguments chosen = arguments.law;
  // The default law, except tracing, which gives no force to a hand at rest.
  for (const haptics::Law law : haptics::laws_for(scene))
    if (chosen.law.empty() && law != haptics::Law::tracing) chosen.law = haptics::name_of(law);
  const auto parameters = law_parameters(chosen, scene);
  if (!parameters) return parameters.error();
  const auto touchable = haptics::make_touchable(scene, *parameters);
  if (!touchable) return touchable.error();
  const double spacing_m = std::max(relief.size_x_m(), relief.size_y_m()) / kArrowsAcross;
  return draw::force_figure(
      relief, scene.texture, forces_on(relief, **touchable, spacing_m), spacing_m,
      title_of(arguments, scene, fmt::format("force of the law {}", haptics::name_of(parameters->law))));
}

double height_of_row_m(const models::Relief& relief, std::ptrdiff_t row) {
  return -(static_cast<double>(row) - 0.5 * (relief.samples_m().height() - 1)) * relief.pixel_m();
}

/// A section through the highest point, so that it shows something.
double cut_through_the_top_m(const models::Relief& relief) {
  const auto& heights = relief.samples_m();
  const auto top = std::max_element(heights.values().begin(), heights.values().end());
  return height_of_row_m(relief, (top - heights.values().begin()) / heights.width());
}

/// A section through as many grooves as possible: the highest point of contours may be anywhere between their
/// lines.
double cut_through_most_lines_m(const models::Relief& relief) {
  const auto& heights = relief.samples_m();
  int best = 0;
  double most_m = -1.0;
  for (int j = 0; j < heights.height(); ++j) {
    double variation_m = 0.0;
    for (int i = 1; i < heights.width(); ++i)
      variation_m += std::abs(static_cast<double>(heights(i, j)) - heights(i - 1, j));
    if (variation_m <= most_m) continue;
    most_m = variation_m;
    best = j;
  }
  return height_of_row_m(relief, best);
}

double default_cut_m(const models::Scene& scene, const models::Relief& relief) {
  const bool is_contours = std::holds_alternative<std::shared_ptr<const models::Contours>>(scene.model);
  return is_contours ? cut_through_most_lines_m(relief) : cut_through_the_top_m(relief);
}

Result<draw::Figure> contours_picture(const ShowArguments& arguments, const models::Scene& scene) {
  const auto* contours = std::get_if<std::shared_ptr<const models::Contours>>(&scene.model);
  if (contours == nullptr) return Error{ErrorCode::usage, "only a scene of contours has this view", "--view"};
  const models::BoundaryMap& map = (*contours)->boundaries;
  return draw::contours_figure(
      sculpt::boundary_lines(map), scene.texture, map.pixel_m(),
      title_of(arguments, scene, fmt::format("contours from strength {:.2f}", map.origin().threshold)));
}

Result<draw::Figure> map_picture(const ShowArguments& arguments, const models::Scene& scene) {
  if (scene.map == nullptr)
    return Error{ErrorCode::usage, "only the scene of a street map has this view", "--view"};
  return draw::map_figure(scene.map, scene.texture, models::size_m(scene).x,
                          title_of(arguments, scene, "street map"));
}

Result<draw::Figure> regions_picture(const ShowArguments& arguments, const models::Scene& scene) {
  if (scene.labels.empty())
    return Error{ErrorCode::usage, "this scene has no regions; make it with --ground or --background",
                 "--view"};
  constexpr std::array<Rgb8, 4> kColours{Rgb8{60, 120, 215}, Rgb8{225, 120, 40}, Rgb8{40, 150, 90},
                                         Rgb8{160, 80, 180}};
  std::vector<draw::Mark> kinds;
  for (std::size_t k = 1; k < scene.materials.size(); ++k)
    kinds.push_back({scene.materials[k].name, kColours[(k - 1) % kColours.size()]});
  Raster<Rgb8> picture(scene.labels.width(), scene.labels.height(), {215, 215, 215});
  const Raster<Rgb8>& texture = scene.texture;
  if (!texture.empty())
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x)
        picture(x, y) =
            texture(x * texture.width() / picture.width(), y * texture.height() / picture.height());
  return draw::marks_figure(std::move(picture), scene.labels, std::move(kinds),
                            title_of(arguments, scene, "regions"),
                            "Tinted: the regions that were found. Not tinted: the objects.");
}

/// A section through the centre, or at `--at`.
template <models::DistanceSurface Distance>
Result<draw::Figure> field_section(const ShowArguments& arguments, const models::Scene& scene,
                                   const std::shared_ptr<const models::SolidField<Distance>>& field) {
  const double cut_m =
      arguments.cut_mm ? *arguments.cut_mm / 1000.0 : 0.5 * (field->least_m.y + field->most_m.y);
  if (!(cut_m >= field->least_m.y && cut_m <= field->most_m.y))
    return Error{ErrorCode::usage,
                 fmt::format("the solid reaches from {:.1f} to {:.1f} mm", 1000.0 * field->least_m.y,
                             1000.0 * field->most_m.y),
                 "--at"};
  return draw::field_section_figure(field, cut_m, arguments.section,
                                    title_of(arguments, scene, "cut from left to right"));
}

Result<draw::Figure> solid_picture(const ShowArguments& arguments, const models::Scene& scene) {
  const draw::FigureTitle title = title_of(arguments, scene, "solid");
  if (const auto* field = std::get_if<std::shared_ptr<const models::Field>>(&scene.model))
    return draw::solid_figure(*field, arguments.solid, title);
  if (const auto* dense = std::get_if<std::shared_ptr<const models::FieldOnLattice>>(&scene.model))
    return draw::solid_figure(*dense, arguments.solid, title);
  return Error{ErrorCode::usage, "only a scene with a field has this view", "--view"};
}

Result<draw::Figure> picture_of(const ShowArguments& arguments, const models::Scene& scene,
                                const models::Relief& relief) {
  if (arguments.view == "solid") return solid_picture(arguments, scene);
  if (arguments.view == "contours") return contours_picture(arguments, scene);
  if (arguments.view == "map") return map_picture(arguments, scene);
  if (const auto* field = std::get_if<std::shared_ptr<const models::Field>>(&scene.model);
      field != nullptr && arguments.view == "section")
    return field_section(arguments, scene, *field);
  if (const auto* dense = std::get_if<std::shared_ptr<const models::FieldOnLattice>>(&scene.model);
      dense != nullptr && arguments.view == "section")
    return field_section(arguments, scene, *dense);
  if (arguments.view == "regions") return regions_picture(arguments, scene);
  if (arguments.view == "relief")
    return draw::relief_figure(relief, title_of(arguments, scene, "relief"),
                               arguments.picture ? scene.texture : Raster<Rgb8>());
  if (arguments.view == "depth") return draw::height_figure(relief, title_of(arguments, scene, "heights"));
  if (arguments.view == "force") return force_picture(arguments, scene, relief);
  const double cut_m = arguments.cut_mm ? *arguments.cut_mm / 1000.0 : default_cut_m(scene, relief);
  if (std::abs(cut_m) > 0.5 * relief.size_y_m())
    return Error{ErrorCode::usage,
                 fmt::format("the relief reaches from {0:.1f} to -{0:.1f} mm", 500.0 * relief.size_y_m()),
                 "--at"};
  return draw::section_figure(relief, cut_m, title_of(arguments, scene, "cut from left to right"));
}

Result<Answer> show(ShowArguments arguments) {
  const auto file = read_scene_argument(arguments.scene);
  if (!file) return file.error();
  const models::Scene& scene = file->scene;
  if (arguments.view.empty()) {
    const std::string kind = models::kind_of(scene.model);
    arguments.view = models::is_field(scene.model) ? "solid" : kind == "grid" ? "section" : kind;
  }
  const auto figure = picture_of(arguments, scene, *models::relief_of(scene));
  if (!figure) return figure.error();
  if (const auto written = draw::write_figure(*figure, arguments.output); !written) return written.error();
  Answer answer;
  answer.json = {{"output", arguments.output},
                 {"view", arguments.view},
                 {"width", figure->width_px},
                 {"height", figure->height_px}};
  answer.text = fmt::format("{}\n", arguments.output);
  return answer;
}

}  // namespace

void add_show(Program& program) {
  const auto arguments = std::make_shared<ShowArguments>();
  Options options = add_command(program, "show", "Draw a scene with axes, scale and legend: PNG, SVG or PDF",
                                "  palpable show aloe.palp -o aloe.png\n"
                                "  palpable show aloe.palp -o force.png --view force --law rolling\n"
                                "  palpable show aloe.palp -o cut.pdf --view section --at 10",
                                [arguments](Console& /*console*/) { return show(*arguments); });
  options.argument("SCENE", arguments->scene, "A .palp scene");
  options.required_output("-o,--output", arguments->output, {".png", ".svg", ".pdf"},
                          "Picture to write (.png, .svg, .pdf)");
  options.choice("--view", arguments->view,
                 {"relief", "depth", "force", "section", "solid", "contours", "regions", "map"},
                 "What to draw; default: the scene as it is touched");
  options.number(
      "--at", arguments->cut_mm, {-500.0, 500.0},
      "Section: where to cut, mm above the middle; default: through the highest point, the middle of "
      "a solid or most lines");
  options.number("--turn", arguments->solid.azimuth_deg, {-180.0, 180.0},
                 "Solid: degrees from its front to the right");
  options.number("--tilt", arguments->solid.elevation_deg, {-89.0, 89.0}, "Solid: degrees from above");
  options.flag("--cells", arguments->section.cells, "Section of a solid: draw the field's cells");
  options.flag("--picture", arguments->picture, "Relief: show the scene's picture on it");
  add_law_options(options, arguments->law);
}

}  // namespace palpable::cli
