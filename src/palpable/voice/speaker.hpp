// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::voice {

/// A speech output. One thread at a time.
class Speaker {
 public:
  Speaker() = default;
  Speaker(const Speaker&) = delete;
  Speaker& operator=(const Speaker&) = delete;
  virtual ~Speaker() = default;

  /// Starts to speak a sentence (UTF-8, one line) and returns at once; a sentence that is being spoken is
  /// interrupted. Errors: the speech program has ended.
  virtual Result<void> say(std::string_view sentence) = 0;
  /// Waits until the last sentence has been spoken, if the speech output would end with this program. say()
  /// fails afterwards.
  virtual void finish() {}
};

/// The desktop's own voice, with the user's settings (speech-dispatcher). Errors: no server answers.
Result<std::unique_ptr<Speaker>> open_speech_dispatcher();

/// A program that speaks each line of its standard input: its name, found on PATH, and its arguments. Its
/// output is discarded. Errors: it cannot be started.
Result<std::unique_ptr<Speaker>> open_speaking_program(const std::vector<std::string>& command);

/// speech-dispatcher if it answers, else espeak-ng. Errors: neither is there.
Result<std::unique_ptr<Speaker>> open_speaker();

}  // namespace palpable::voice
