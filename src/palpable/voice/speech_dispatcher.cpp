// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/voice/speaker.hpp"

#include <cstdlib>
#include <string>

#include <libspeechd.h>

namespace palpable::voice {
namespace {

class SpeechDispatcher final : public Speaker {
 public:
  explicit SpeechDispatcher(SPDConnection* connection) : connection_(connection) {}
  ~SpeechDispatcher() override { spd_close(connection_); }

  Result<void> say(std::string_view sentence) override {
    spd_cancel(connection_);
    if (spd_say(connection_, SPD_TEXT, std::string(sentence).c_str()) < 0)
      return Error{ErrorCode::failed, "does not speak any more", "speech-dispatcher"};
    return {};
  }

 private:
  SPDConnection* connection_;
};

}  // namespace

Result<std::unique_ptr<Speaker>> open_speech_dispatcher() {
  char* why = nullptr;
  // Does not start a server, which would outlive this program: only a running one is used.
  SPDConnection* connection = spd_open2("palpable", nullptr, nullptr, SPD_MODE_SINGLE, nullptr, 0, &why);
  const std::string reason = why == nullptr ? "no answer" : why;
  std::free(why);
  if (connection == nullptr)
    return Error{ErrorCode::failed, "cannot be reached (" + reason + ")", "speech-dispatcher"};
  return std::unique_ptr<Speaker>(std::make_unique<SpeechDispatcher>(connection));
}

}  // namespace palpable::voice
