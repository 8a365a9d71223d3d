// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/keys/touch_by_keys.hpp"

#include "palpable/cli/keys/key_probe.hpp"
#include "palpable/describe/scene_words.hpp"
#include "palpable/voice/voice.hpp"

#include <chrono>
#include <memory>
#include <string>
#include <utility>

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

/// Runs until Q, the end of the input or an interruption.
Result<void> explore(session::TouchSession& session, session::MakerThread& maker, Mouth& mouth) {
  KeyProbe probe;
  TerminalKeys keys;
  mouth.say(describe::opening_words(*session.scene()), voice::Importance::news);
  while (!interrupted() && !keys.ended()) {
    if (auto better = maker.take(std::chrono::milliseconds(0))) {
      if (auto changed = session.change_scene(std::move(better)); !changed) return changed;
      mouth.say("A finer version of the scene is in place.", voice::Importance::news);
    }
    const auto scene = session.scene();
    if (const auto key = keys.next(kBeat)) {
      std::string words;
      const auto request = probe.press(*key, *scene, session.settings().height_factor, words);
      if (request == KeyProbe::Request::end) return {};
      if (request == KeyProbe::Request::pause) pause_or_go_on(session, mouth);
      // A key that is held down sends more moves than can be read, so only the last one is described.
      if (!is_move(*key) || !keys.waiting()) mouth.say(words, voice::Importance::label);
    }
    session.move_pointer(probe.hand(*scene, session.settings()));
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
  auto explored = explore(session, maker, mouth);
  maker.cancel();
  auto recorded = session.stop_recording();
  session.stop();
  if (!explored) return std::move(explored).error();
  if (!recorded) return std::move(recorded).error();
  return session.statistics();
}

}  // namespace palpable::cli
