// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/keys/key_probe.hpp"

#include "palpable/describe/found_places.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/describe/scene_words.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

using Name = TerminalKey::Name;

// For a scene of 0.1 m.
constexpr double kStep_m = 0.001, kLongStep_m = 0.005;
constexpr double kPressStep_m = 0.0005, kDeepest_m = 0.004, kHighest_m = -0.02;

/// Factor of the steps for this scene relative to one of 0.1 m: 1, 2 or 5 times a power of ten.
double scale_of(const models::Scene& scene) {
  constexpr double kUsual_m = 0.1;
  const Vec3 size = models::size_m(scene);
  const double scale = std::max(size.x, size.y) / kUsual_m,
               power = std::pow(10.0, std::floor(std::log10(scale)));
  double best = power;
  for (const double factor : {2.0, 5.0, 10.0})
    if (std::abs(std::log(factor * power / scale)) < std::abs(std::log(best / scale))) best = factor * power;
  return best;
}

/// Small scenes are pressed less deep, but deep enough to be felt; large ones as deep as one of 0.1 m.
double press_scale_of(const models::Scene& scene) { return std::clamp(scale_of(scene), 0.2, 1.0); }

}  // namespace

bool is_move(const TerminalKey& key) {
  return key.name == Name::left || key.name == Name::right || key.name == Name::up || key.name == Name::down;
}

KeyProbe::Request KeyProbe::press(const TerminalKey& key, const models::Scene& scene, double height_factor,
                                  std::string& words) {
  const double step_m = scale_of(scene) * (key.shift ? kLongStep_m : kStep_m);
  const std::size_t part = std::exchange(next_part_, 0);
  words.clear();
  switch (key.name) {
    case Name::left:
      return words = move(-step_m, 0.0, scene, height_factor), Request::nothing;
    case Name::right:
      return words = move(step_m, 0.0, scene, height_factor), Request::nothing;
    case Name::up:
      return words = move(0.0, step_m, scene, height_factor), Request::nothing;
    case Name::down:
      return words = move(0.0, -step_m, scene, height_factor), Request::nothing;
    case Name::page_down:
      return words = press_by(kPressStep_m, scene), Request::nothing;
    case Name::page_up:
      return words = press_by(-kPressStep_m, scene), Request::nothing;
    case Name::home:
      place_ = {models::centre_m(scene).x, models::centre_m(scene).y};
      press_m_ = kRestingPress_m;
      return words =
                 models::is_field(scene.model)
                     ? fmt::format("In the middle. {}.",
                                   describe::capitalised(describe::step_words(scene, height_factor, place_)))
                     : "In the middle.",
             Request::nothing;
    case Name::end:
      return words = to_surface(scene, height_factor), Request::nothing;
    case Name::character:
      break;
  }
  constexpr char kEndOfText = '\x04';
  switch (key.character) {
    case 'd':
      words = describe::scene_part(scene, height_factor, place_, part);
      next_part_ = part + 1;
      break;
    case 'p':
      words = describe::position_words(scene, height_factor, place_, describe::PlaceGuide(scene));
      // It told the sentence, which the next step need not.
      commentary_.untold_sentence(scene, place_);
      break;
    case 'l':
      return Request::list_names;
    case 't':
      return Request::type_name;
    case 'f':
      return Request::find_name;
    case 'g':
      return Request::say_way;
    case 'u':
      return Request::undo_name;
    case 's':
      return Request::save;
    case 'h':
    case '?':
      words = help(scene);
      break;
    case ' ':
      return Request::pause;
    case '+':
    case '=':
      return scene.map != nullptr ? Request::zoom_in : Request::nothing;
    case '-':
      return scene.map != nullptr ? Request::zoom_out : Request::nothing;
    case 'q':
    case kEndOfText:
      return Request::end;
    default:
      break;
  }
  return Request::nothing;
}

std::string KeyProbe::move(double dx_m, double dy_m, const models::Scene& scene, double height_factor) {
  const Vec3 size = models::size_m(scene);
  const describe::Place wanted{place_.x_m + dx_m, place_.y_m + dy_m};
  place_ = {std::clamp(wanted.x_m, -0.5 * size.x, 0.5 * size.x),
            std::clamp(wanted.y_m, -0.5 * size.y, 0.5 * size.y)};
  const bool at_rim = place_.x_m != wanted.x_m || place_.y_m != wanted.y_m;
  const std::string words = describe::step_words(scene, height_factor, place_);
  return describe::capitalised((at_rim ? "rim of the scene, " : "") + words) + "." +
         commentary_.untold_sentence(scene, place_);
}

std::string KeyProbe::to_surface(const models::Scene& scene, double height_factor) {
  const auto surface = describe::nearest_surface(scene, place_);
  if (!surface) return "There is nothing to touch.";
  place_ = *surface;
  return fmt::format("At the surface, {}.", describe::step_words(scene, height_factor, place_));
}

std::string KeyProbe::press_by(double further_m, const models::Scene& scene) {
  press_m_ = std::clamp(press_m_ + further_m, kHighest_m, kDeepest_m);
  return describe::capitalised(describe::press_words(scene, place_, press_scale_of(scene) * press_m_)) + ".";
}

Point<SceneFrame> KeyProbe::hand(const models::Scene& scene, const session::TouchSettings& settings) const {
  const double surface_m =
      settings.height_factor * models::relief_of(scene)->sample(place_.x_m, place_.y_m).z_m;
  return {{place_.x_m, place_.y_m,
           surface_m + settings.law.radius_m.value_or(0.0) - press_scale_of(scene) * press_m_}};
}

std::string KeyProbe::help(const models::Scene& scene) {
  const double scale = scale_of(scene);
  const std::string zoom =
      scene.map != nullptr ? "Plus, minus: enlarge the map about the probe, and back.\n" : "";
  return fmt::format("Arrow keys: move by {}, with Shift by {}.\n", describe::spoken_length(scale * kStep_m),
                     describe::spoken_length(scale * kLongStep_m)) +
         "Page Down, Page Up: press deeper, lift.\n"
         "D: describe the scene; again for more.\n"
         "P: say position and height.\n"
         "Home: back to the middle. End: to the nearest surface.\n"
         "L: list the names, the nearest first.\n"
         "F: find a name, which is typed. G: the way again.\n"
         "T: type a name for this place, or NAME: SENTENCE. U: undo that.\n"
         "S: save the scene with its names.\n" +
         zoom +
         "Space: pause, resume.\n"
         "Q: end.";
}

}  // namespace palpable::cli
