// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/voice/speaker.hpp"

namespace palpable::voice {

Result<std::unique_ptr<Speaker>> open_speaker() {
  if (auto dispatcher = open_speech_dispatcher()) return dispatcher;
  if (auto espeak = open_speaking_program({"espeak-ng"})) return espeak;
  return Error{ErrorCode::failed, "nothing can speak here: install speech-dispatcher or espeak-ng", {}};
}

}  // namespace palpable::voice
