// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::voice {

/// Something that speaks. One thread at a time.
class Speaker {
 public:
  Speaker() = default;
  Speaker(const Speaker&) = delete;
  Speaker& operator=(const Speaker&) = delete;
  virtual ~Speaker() = default;

  /// Hands a sentence (UTF-8, one line) over and returns before it is spoken; a sentence that is being spoken
  /// gives way. Errors: whoever speaks is gone.
  virtual Result<void> say(std::string_view sentence) = 0;
  /// Waits until what was handed over has been spoken, where whoever speaks would fall silent with us; says
  /// nothing after that.
  virtual void finish() {}
};

/// The desktop's own voice, with the person's settings (speech-dispatcher). Errors: no server answers.
Result<std::unique_ptr<Speaker>> open_speech_dispatcher();

/// A program that speaks each line of its standard input: its name, found on PATH, and arguments. What it
/// prints is thrown away. Errors: it cannot be started.
Result<std::unique_ptr<Speaker>> open_speaking_program(const std::vector<std::string>& command);

/// speech-dispatcher if it answers, else espeak-ng. Errors: neither is there.
Result<std::unique_ptr<Speaker>> open_speaker();

}  // namespace palpable::voice
