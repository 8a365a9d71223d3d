// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/keys/touch_by_keys.hpp"

#include "palpable/cli/keys/key_names.hpp"
#include "palpable/cli/keys/key_probe.hpp"
#include "palpable/describe/map_route_words.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/describe/scene_words.hpp"
#include "palpable/models/streets/map_view.hpp"
#include "palpable/voice/voice.hpp"

#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

// A pointer that is silent for half a second counts as lost.
constexpr std::chrono::milliseconds kBeat{50};

/// Prints sentences, and speaks them if there is a speech output.
class Mouth {
 public:
  Mouth(Console& console, bool aloud) : console_(console) {
    if (!aloud) return;
    auto speaker = voice::open_speaker();
    if (speaker)
      voice_ = std::make_unique<voice::Voice>(*std::move(speaker));
    else
      console.note(speaker.error().sentence());
  }
  void say(const std::string& words, voice::Importance importance) {
    if (words.empty()) return;
    console_.say(words);
    if (voice_) voice_->say(importance, words);
  }

 private:
  Console& console_;
  std::unique_ptr<voice::Voice> voice_;
};

void pause_or_go_on(session::TouchSession& session, Mouth& mouth) {
  if (session.paused())
    session.resume();
  else
    session.pause();
  mouth.say(session.paused() ? "Paused: no force." : "Going on.", voice::Importance::news);
}

/// Enlarges and reduces a street map about the probe.
class MapZoom {
 public:
  explicit MapZoom(const recipes::MapRecipe& recipe) : recipe_(recipe) {}

  /// A new scene was made: it is shown whole.
  void begin(std::shared_ptr<const models::Scene> whole) {
    whole_ = std::move(whole);
    view_ = {};
  }

  /// Changes the scene; what to say.
  Result<std::string> change(session::TouchSession& session, describe::Place place, bool in) {
    constexpr double kStep = 2.0, kMost = 16.0;
    const double zoom = in ? view_.zoom * kStep : view_.zoom / kStep;
    if (zoom > kMost) return std::string("That is the largest scale.");
    if (zoom < 1.0) return std::string("That is the whole map.");
    const MapPoint at = describe::MapGuide(*whole_).pixel_of(place);
    const models::MapView view = models::zoomed_about(*whole_->map, view_, at, zoom);
    auto scene = whole_;
    if (zoom > 1.0) {
      auto made = recipes::part_of_map(*whole_, view, recipe_);
      if (!made && made.error().code == ErrorCode::invalid_input) return std::string("No streets are there.");
      if (!made) return made.error();
      scene = std::make_shared<const models::Scene>(std::move(made->scene));
    }
    if (auto changed = session.change_scene(scene); !changed) return changed.error();
    view_ = view;
    const describe::MapGuide guide(*scene, describe::MapStreets::felt);
    const std::string width = guide.map().metres_per_px > 0.0
                                  ? ", " + guide.distance_words(guide.map().width_px) + " across"
                                  : std::string();
    return fmt::format("{}{}, {}. {}",
                       zoom > 1.0 ? fmt::format("Enlarged {:g} times", zoom) : "The whole map", width,
                       describe::counted(guide.streets().size(), "street", "streets"),
                       describe::map_position_words(guide, place));
  }

 private:
  recipes::MapRecipe recipe_;
  std::shared_ptr<const models::Scene> whole_;
  models::MapView view_;
};

/// What the keys ask of the names; a name that is to be typed is awaited.
class NameKeys {
 public:
  using Request = KeyProbe::Request;
  explicit NameKeys(std::filesystem::path save_as) : names_(std::move(save_as)) {}

  std::shared_ptr<const models::Scene> named(const std::shared_ptr<const models::Scene>& touched) {
    return names_.named(touched);
  }
  std::string left_over_words() const { return names_.left_over_words(); }
  std::string unsaved_words() const { return names_.unsaved_words(); }
  Result<void> none_lost() const { return names_.none_lost(); }
  bool awaits_line() const { return awaited_ != Request::nothing; }
  /// A typed line; what to say.
  std::string take_line(const models::Scene& scene, Place place, const std::string& line) {
    return std::exchange(awaited_, Request::nothing) == Request::find_name ? names_.find(scene, place, line)
                                                                           : names_.name(scene, place, line);
  }
  /// A key's request; what to say, or `words` if it asks nothing of names. A move says the way instead.
  std::string answer(Request request, bool moves, const models::Scene& scene, Place place,
                     std::string words) {
    switch (request) {
      case Request::list_names:
        return names_.list(scene, place);
      case Request::type_name:
        awaited_ = request;
        return "Type the name of this place, then Enter:";
      case Request::find_name:
        awaited_ = request;
        return "Type the name to find, then Enter:";
      case Request::undo_name:
        return names_.undo(scene);
      case Request::save:
        return names_.save(scene);
      case Request::say_way: {
        std::string way = names_.way(scene, place);
        return way.empty() ? "You are led to no name. F finds one." : way;
      }
      default:
        break;
    }
    if (!moves) return words;
    std::string way = names_.way(scene, place);
    return way.empty() ? words : way;
  }

 private:
  KeyNames names_;
  Request awaited_ = Request::nothing;
};

/// Runs until Q, the end of the input or an interruption.
Result<void> explore(session::TouchSession& session, session::MakerThread& maker, MapZoom zoom,
                     NameKeys& names, Mouth& mouth) {
  KeyProbe probe;
  probe.begin(*session.scene());
  zoom.begin(session.scene());
  TerminalKeys keys;
  mouth.say(describe::opening_words(*session.scene()), voice::Importance::news);
  mouth.say(names.left_over_words(), voice::Importance::news);
  while (!interrupted() && !keys.ended()) {
    if (auto better = maker.take(std::chrono::milliseconds(0))) {
      if (auto changed = session.change_scene(better); !changed) return changed;
      zoom.begin(std::move(better));
      mouth.say("A finer version of the scene is in place.", voice::Importance::news);
    }
    const auto scene = names.named(session.scene());
    if (names.awaits_line()) {
      if (const auto line = keys.next_line(kBeat))
        mouth.say(names.take_line(*scene, probe.place(), *line), voice::Importance::label);
    } else if (const auto key = keys.next(kBeat)) {
      std::string words;
      const auto request = probe.press(*key, *scene, session.settings().height_factor, words);
      if (request == KeyProbe::Request::end) return {};
      if (request == KeyProbe::Request::zoom_in || request == KeyProbe::Request::zoom_out) {
        auto said = zoom.change(session, probe.place(), request == KeyProbe::Request::zoom_in);
        if (!said) return std::move(said).error();
        words = *std::move(said);
      }
      if (request == KeyProbe::Request::pause) pause_or_go_on(session, mouth);
      words = names.answer(request, is_move(*key), *scene, probe.place(), std::move(words));
      // A key that is held down sends more moves than can be read, so only the last one is described.
      if (!is_move(*key) || !keys.waiting()) mouth.say(words, voice::Importance::label);
    }
    session::TouchSettings used = session.settings();
    used.law.radius_m = session.radius_in_use_m();
    session.move_pointer(probe.hand(*scene, used));
  }
  return {};
}

}  // namespace

Result<session::TouchStatistics> touch_by_keys(const session::SceneMaker& make,
                                               const KeyTouchOptions& options, Console& console) {
  session::MakerThread maker(make, console.work());
  auto scene = maker.first_scene(console.work());
  if (!scene) return std::move(scene).error();
  session::SessionOptions session_options = options.session;
  session_options.recording = options.recording;
  auto opened = session::TouchSession::open(std::move(*scene), options.settings, "pointer:", session_options,
                                            options.begin_ns);
  if (!opened) return std::move(opened).error();
  session::TouchSession& session = **opened;
  // A finer scene may still be made during the touch.
  console.end_progress();
  for (const std::string& notice : session.notices()) console.note(notice);
  Mouth mouth(console, options.aloud);
  NameKeys names(options.save_as);
  auto explored = explore(session, maker, MapZoom(options.map), names, mouth);
  mouth.say(names.unsaved_words(), voice::Importance::news);
  maker.cancel();
  auto recorded = session.stop();
  if (!explored) return std::move(explored).error();
  if (!recorded) return std::move(recorded).error();
  if (auto kept = names.none_lost(); !kept) return std::move(kept).error();
  return session.statistics();
}

}  // namespace palpable::cli
