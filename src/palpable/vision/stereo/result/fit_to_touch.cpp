// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/result/fit_to_touch.hpp"

#include "palpable/core/check.hpp"
#include "palpable/vision/image/census.hpp"
#include "palpable/vision/image/colour_planes.hpp"
#include "palpable/vision/stereo/confidence/confidence.hpp"
#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/occlusion/left_right_check.hpp"
#include "palpable/vision/stereo/problem/epipolar_pictures.hpp"
#include "palpable/vision/stereo/problem/prepare_pictures.hpp"
#include "palpable/vision/stereo/range/pair_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::vision {
namespace {

bool textured_at(const Raster<std::uint8_t>& grey, int x, int y) {
  const int last_x = std::max(kCensusHalfX, grey.width() - 1 - kCensusHalfX),
            last_y = std::max(kCensusHalfY, grey.height() - 1 - kCensusHalfY);
  return has_texture(grey, std::clamp(x, kCensusHalfX, last_x), std::clamp(y, kCensusHalfY, last_y));
}

/// The left picture and a reduced copy: a small plain area is matched by the patterns around it, a plain wall
/// is not.
struct Sizes {
  static constexpr int kFactor = 4;
  Raster<std::uint8_t> fine;
  Raster<std::uint8_t> coarse;
};

/// Whether fine contrast is texture, or camera noise, which differs between pictures.
enum class Texture { real, grain };

Texture kind_of_texture(const Raster<std::uint8_t>& grey, const Raster<float>& confirmed_px,
                        const FitThresholds& thresholds) {
  const auto sure = std::count_if(confirmed_px.values().begin(), confirmed_px.values().end(),
                                  [](float c) { return c > 0.0F; });
  const bool confirmed =
      static_cast<double>(sure) > thresholds.confirmed_texture * static_cast<double>(confirmed_px.count());
  return !confirmed && contrast_beyond_grain(grey) < thresholds.only_grain ? Texture::grain : Texture::real;
}

/// Whether the right picture has the place where it would show a left pixel with this disparity.
bool in_right_view(int x, int y, float disparity_px, const StereoPair& pair) {
  if (!std::isfinite(disparity_px)) return false;
  const auto d = static_cast<double>(disparity_px);
  const PicturePoint there =
      pair.frame ? right_point(*pair.frame, {1.0 * x, 1.0 * y}, d) : PicturePoint{x - d, 1.0 * y};
  return there.x >= -0.5 && there.x <= pair.left.width - 0.5 &&
         (!pair.frame || (there.y >= -0.5 && there.y <= pair.left.height - 0.5));
}

Trouble trouble_at(int x, int y, const Sizes& grey, Texture texture, const StereoPair& pair,
                   const StereoMatch& match) {
  if (!in_right_view(x, y, match.disparity.disparity_px(x, y), pair)) return Trouble::out_of_view;
  // A plain surface filled from its surroundings is often right, but unconfirmed.
  const bool plain =
      !textured_at(grey.fine, x, y) && !textured_at(grey.coarse, x / Sizes::kFactor, y / Sizes::kFactor);
  if (plain || texture == Texture::grain) return Trouble::plain;
  if (match.confirmed(x, y) <= 0.0F) return Trouble::contradicted;
  return match.confidence(x, y) < kGuessedBelow ? Trouble::guessed : Trouble::none;
}

double share_of(const Raster<std::uint8_t>& trouble, Trouble which) {
  const auto n =
      std::count(trouble.values().begin(), trouble.values().end(), static_cast<std::uint8_t>(which));
  return static_cast<double>(n) / static_cast<double>(trouble.count());
}

/// The share of each trouble in one ninth of the picture.
struct Ninth {
  std::string name;
  std::array<double, 5> shares{};
  double wrong() const { return 1.0 - shares[0]; }
};

Ninth place_in(const Raster<std::uint8_t>& trouble, int column, int row) {
  static constexpr std::array<const char*, 9> kNames{
      "at the upper left", "at the top",        "at the upper right", "on the left",       "in the middle",
      "on the right",      "at the lower left", "at the bottom",      "at the lower right"};
  Ninth place{kNames[static_cast<std::size_t>(3 * row + column)], {}};
  const int x0 = trouble.width() * column / 3, x1 = trouble.width() * (column + 1) / 3;
  const int y0 = trouble.height() * row / 3, y1 = trouble.height() * (row + 1) / 3;
  const double each = 1.0 / (static_cast<double>(x1 - x0) * (y1 - y0));
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) place.shares[trouble(x, y)] += each;
  return place;
}

Ninth worst_place(const Raster<std::uint8_t>& trouble) {
  Ninth worst = place_in(trouble, 0, 0);
  for (int i = 1; i < 9; ++i) {
    Ninth here = place_in(trouble, i % 3, i / 3);
    if (here.wrong() > worst.wrong()) worst = std::move(here);
  }
  return worst;
}

/// The main trouble of a place, and advice for the user.
struct Advice {
  const char* why;
  const char* what;
};

Advice advice_for(const Ninth& place, bool is_dark) {
  const auto most = std::max_element(place.shares.begin() + 1, place.shares.end()) - place.shares.begin();
  switch (static_cast<Trouble>(most)) {
    case Trouble::out_of_view:
      return {"only one picture shows it",
              "let the two pictures overlap more: move the cameras closer together, or step back"};
    case Trouble::plain:
      if (is_dark) return {"it is too dark to show any surface", "give it more light"};
      return {"there is no texture to go by", "light it from the side, or lay something patterned there"};
    case Trouble::guessed:
      return {"the depth is guessed from its surroundings",
              "light it from the side, or lay something patterned there"};
    default:
      if (is_dark) return {"the two pictures contradict each other in the dark", "give it more light"};
      return {"the two pictures contradict each other",
              "make sure that nothing moves or shines there, and keep near objects an arm's length away"};
  }
}

/// Logistic score of a figure: 0.5 at its threshold, 0.12 or 0.88 one `width` below or above it.
double margin(double figure, double threshold, double width) {
  return 1.0 / (1.0 + std::exp(-2.0 * (figure - threshold) / width));
}

using Margin = std::pair<double, FitReason>;

/// Scores from distinct points; with few of them, both matching directions must agree better.
std::vector<Margin> geometry_margins(const FitToTouch& fit, const FitThresholds& at) {
  if (fit.points.count < at.points) {
    std::vector<Margin> margins{
        {margin(fit.agreement, at.agreement_without_points, 0.05), FitReason::few_points},
        {margin(fit.depth_range_px, at.range_without_points_px, 1.0), FitReason::no_parallax}};
    if (fit.points.count >= at.least_points)
      margins.emplace_back(margin(fit.points.confirmed, at.confirmed, 0.2), FitReason::different_places);
    return margins;
  }
  std::vector<Margin> margins{{margin(fit.points.confirmed, at.confirmed, 0.1), FitReason::different_places},
                              {margin(fit.points.off_plane, at.off_plane, 0.01), FitReason::no_parallax}};
  if (!fit.points.rigid) return margins;
  margins.emplace_back(margin(fit.points.beyond_turn, at.beyond_turn, 0.02), FitReason::no_parallax);
  margins.emplace_back(margin(fit.points.certainty, at.certainty, 0.1), FitReason::uncertain_motion);
  margins.emplace_back(margin(fit.points.depth_order, at.depth_order, 0.1), FitReason::other_order);
  return margins;
}

/// The lowest score decides.
void decide(FitToTouch& fit, const FitThresholds& at) {
  std::vector<Margin> margins = geometry_margins(fit, at);
  margins.emplace_back(margin(fit.agreement, at.agreement, 0.05), FitReason::contradiction);
  margins.emplace_back(margin(fit.coverage, at.coverage, 0.1), FitReason::little_depth);
  const auto [confidence, reason] = *std::min_element(margins.begin(), margins.end());
  fit.confidence = confidence;
  fit.fit = confidence >= 0.5;
  fit.reason = fit.fit ? FitReason::all_agree : reason;
}

/// Mirrored horizontally.
Image mirror_image(const Image& image) {
  Image out = image;
  const auto channels = static_cast<std::size_t>(image.channels);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      std::copy_n(image.pixel(image.width - 1 - x, y), channels,
                  out.samples.begin() + (image.pixel(x, y) - image.samples.data()));
  return out;
}

/// Judges an exchanged pair as it was matched: mirrored, its first picture is the left one.
FitToTouch fit_of_exchanged(const StereoPair& pair, const StereoMatch& match, const Work& work,
                            const FitThresholds& thresholds) {
  const StereoMatch as_matched{{mirrored(match.disparity.disparity_px), {}},
                               mirrored(match.confidence),
                               mirrored(match.confirmed),
                               {},
                               false};
  FitToTouch fit =
      fit_to_touch({mirror_image(pair.left), mirror_image(pair.right), {}}, as_matched, work, thresholds);
  for (int y = 0; y < fit.trouble.height(); ++y)
    std::reverse(fit.trouble.row(y).begin(), fit.trouble.row(y).end());
  return fit;
}

}  // namespace

std::vector<Parameter> parameters_of(FitWordsOptions& o) {
  return {{"doubtful_confidence", &o.doubtful_confidence, {0, 1}, "", "confidence from which it is doubtful"},
          {"wrong_share", &o.wrong_share, {0, 1}, "", "share of a ninth that is named as wrong"},
          {"flat_px", &o.flat_px, {0, 100}, "px", "range of disparities that feels flat"},
          {"dark_level", &o.dark_level, {0, 1}, "", "median level below which the picture is dark"},
          {"black_level", &o.black_level, {0, 1}, "", "median level below which the picture is black"},
          {"textured_share", &o.textured_share, {0, 1}, "", "texture with which only geometry is named"},
          {"guessed_share", &o.guessed_share, {0, 1}, "", "share of guessed depth that is said"}};
}

std::vector<Parameter> parameters_of(FitThresholds& thresholds) {
  std::vector<Parameter> parameters{
      {"points", &thresholds.points, {1, 10000}, "", "distinct points that decide"},
      {"least_points",
       &thresholds.least_points,
       {1, 10000},
       "",
       "distinct points below which they decide nothing"},
      {"confirmed", &thresholds.confirmed, {0, 1}, "", "share of them that the dense match confirms"},
      {"off_plane", &thresholds.off_plane, {0, 1}, "", "share of the confirmed ones off the dominant plane"},
      {"beyond_turn", &thresholds.beyond_turn, {0, 1}, "", "share of them that no turn and zoom explains"},
      {"certainty", &thresholds.certainty, {0, 1}, "", "how surely the motion says which is nearer"},
      {"depth_order", &thresholds.depth_order, {0, 1}, "", "agreement of the order of depths with theirs"},
      {"agreement",
       &thresholds.agreement,
       {0, 1},
       "",
       "share of the common view that both directions confirm"},
      {"agreement_without_points",
       &thresholds.agreement_without_points,
       {0, 1},
       "",
       "the same with few points"},
      {"range_without_points_px",
       &thresholds.range_without_points_px,
       {0, 100},
       "px",
       "disparities with few points"},
      {"coverage", &thresholds.coverage, {0, 1}, "", "share of the picture that is confirmed"},
      {"confirmed_texture",
       &thresholds.confirmed_texture,
       {0, 1},
       "",
       "confirmed share above which contrast is texture"},
      {"only_grain",
       &thresholds.only_grain,
       {0, 10},
       "",
       "contrast of a reduced copy below which it is noise"}};
  append_parameters(parameters, "confirming", parameters_of(thresholds.confirming));
  append_parameters(parameters, "words", parameters_of(thresholds.words));
  return parameters;
}

Result<StereoMatch> match_confirmed(const StereoPair& pair, StereoMethod method, const StereoOptions& options,
                                    const Work& work) {
  if (pair.frame) {
    auto found = match_confirmed(in_epipolar_frame(pair), method, options, work);
    return found ? in_left_picture(std::move(*found), pair) : found;
  }
  auto forth = match(pair, method, options, work);
  if (!forth || method == StereoMethod::fast) return forth;
  auto back = match({mirror_image(pair.right), mirror_image(pair.left), {}}, method, options, work);
  if (!back) return back;
  const Raster<float>&there = forth->disparity.disparity_px, &here = back->disparity.disparity_px;
  forth->confirmed = forth->exchanged ? mirrored(left_right_check(mirrored(there), here))
                                      : left_right_check(there, mirrored(here));
  return forth;
}

FitToTouch fit_to_touch(const StereoPair& pair, const StereoMatch& match, const Work& work,
                        const FitThresholds& thresholds) {
  PALPABLE_CHECK(!match.confirmed.empty());
  if (match.exchanged) return fit_of_exchanged(pair, match, work, thresholds);
  MatchInput input = prepare_pictures(pair, work);
  Sizes sizes;
  sizes.coarse = shrunk(input.left_grey, Sizes::kFactor);
  const Texture texture = kind_of_texture(input.left_grey, match.confirmed, thresholds);
  sizes.fine = std::move(input.left_grey);
  FitToTouch fit;
  fit.trouble = Raster<std::uint8_t>(pair.left.width, pair.left.height);
  for (int y = 0; y < fit.trouble.height(); ++y)
    for (int x = 0; x < fit.trouble.width(); ++x)
      fit.trouble(x, y) = static_cast<std::uint8_t>(trouble_at(x, y, sizes, texture, pair, match));
  const double good = share_of(fit.trouble, Trouble::none),
               contradicted = share_of(fit.trouble, Trouble::contradicted);
  fit.coverage = good;
  fit.guessed =
      static_cast<double>(std::count_if(match.confidence.values().begin(), match.confidence.values().end(),
                                        [](float c) { return c < kGuessedBelow; })) /
      static_cast<double>(match.confidence.count());
  fit.textured = 1.0 - share_of(fit.trouble, Trouble::plain);
  fit.overlap = 1.0 - share_of(fit.trouble, Trouble::out_of_view);
  const double agreeing = good + share_of(fit.trouble, Trouble::guessed);
  fit.agreement = agreeing + contradicted > 0.0 ? agreeing / (agreeing + contradicted) : 0.0;
  const Raster<float>& d = match.disparity.disparity_px;
  fit.depth_range_px = static_cast<double>(quantile_where(d, match.confirmed, 0.95) -
                                           quantile_where(d, match.confirmed, 0.05));
  Raster<float> luma = grey(pair.left);
  const auto middle = luma.values().begin() + static_cast<std::ptrdiff_t>(luma.count() / 2);
  std::nth_element(luma.values().begin(), middle, luma.values().end());
  fit.brightness = static_cast<double>(*middle);
  fit.points = confirming_points(pair, d, thresholds.confirming);
  decide(fit, thresholds);
  return fit;
}

std::string_view words_of(FitReason reason) {
  static constexpr std::array<std::string_view, 8> kWords{
      "distinct points, parallax and both matching directions agree",
      "hardly any point is found in both pictures",
      "the points that both pictures show do not lie beside each other: they show different places, or the "
      "camera was not moved from left to right",
      "near and far moved alike: the pictures are the same, or the camera was turned or zoomed instead of "
      "moved",
      "the pictures contradict each other in too many places",
      "too little of the picture has a depth that both pictures confirm",
      "the points fit several movements of the camera with different depths: move it farther to the side, "
      "not towards the scene, and do not zoom",
      "near and far of the depth do not agree with how distinct points moved: move the camera farther to the "
      "side, and hold it level"};
  return kWords[static_cast<std::size_t>(reason)];
}

std::string sentence_of(const FitToTouch& fit, const FitWordsOptions& options) {
  const char* verdict = fit.fit ? "This pair is fit to touch"
                        : fit.confidence >= options.doubtful_confidence
                            ? "This pair can be touched, with doubt"
                            : "This pair is hardly fit to touch";
  if (!fit.fit && fit.brightness < options.black_level)
    return fmt::format("{}: the left picture is almost black: take the cap off the lens, or give more light.",
                       verdict);
  const bool geometry_fails =
      fit.reason == FitReason::different_places || fit.reason == FitReason::no_parallax ||
      fit.reason == FitReason::uncertain_motion || fit.reason == FitReason::other_order;
  if (geometry_fails && fit.textured >= options.textured_share) {
    // Distinct points may be on a wall only, before which plain things stand.
    const bool may_be_plain = fit.reason == FitReason::no_parallax && fit.depth_range_px >= options.flat_px;
    return fmt::format(
        "{}: {}{}.", verdict, words_of(fit.reason),
        may_be_plain ? ", or what stands nearer is of one colour: lay something patterned there" : "");
  }
  // With texture and light, points would be found: no place of the picture is to blame.
  if (fit.reason == FitReason::few_points && fit.confidence < options.doubtful_confidence &&
      fit.textured >= options.textured_share && fit.brightness >= options.dark_level)
    return fmt::format(
        "{}: {}: they show different places, were taken from places too far apart, or one is turned, zoomed "
        "or "
        "mirrored.",
        verdict, words_of(fit.reason));
  std::string figures =
      fmt::format("the pictures confirm each other on {:.0f} % of what both show, {:.0f} % of the whole",
                  100.0 * fit.agreement, 100.0 * fit.coverage);
  if (fit.guessed >= options.guessed_share)
    figures +=
        fmt::format(", and the depth of {:.0f} % is guessed from its surroundings", 100.0 * fit.guessed);
  if (fit.depth_range_px < options.flat_px)
    return fmt::format(
        "{}: {}; but near and far differ by only {:.1f} pixels, so it will feel flat: go nearer, or move the "
        "cameras farther apart.",
        verdict, figures, fit.depth_range_px);
  const Ninth worst = worst_place(fit.trouble);
  if (worst.wrong() < options.wrong_share) return fmt::format("{}: {}.", verdict, figures);
  const Advice advice = advice_for(worst, fit.brightness < options.dark_level);
  return fmt::format("{}: {}; it will feel wrong {}, where {} ({:.0f} % of that place): {}.", verdict,
                     figures, worst.name, advice.why, 100.0 * worst.wrong(), advice.what);
}

}  // namespace palpable::vision
