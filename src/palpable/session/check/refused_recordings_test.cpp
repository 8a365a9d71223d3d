// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/check/test_recordings.hpp"
#include "palpable/session/touch/export_recording.hpp"

#include <limits>

namespace palpable::session {
namespace {

/// What check, export and replay say about a file; each must refuse it.
std::vector<std::string> refusals(const std::filesystem::path& file) {
  std::vector<std::string> words;
  const auto note = [&](const char* who, const auto& result) {
    EXPECT_FALSE(result) << who;
    if (result) return;
    EXPECT_EQ(result.error().code, ErrorCode::invalid_input) << who;
    words.push_back(result.error().message);
  };
  note("check", check_recording(file, {}, {}));
  for (const char* output : {"refused.csv", "refused.npz"}) {
    note("export", export_recording(file, in_temp(output), {}));
    EXPECT_FALSE(std::filesystem::exists(in_temp(output)));
  }
  auto replayed = unprivileged(0.2);
  replayed.device_url = "replay:" + file.string();
  note("replay", touch_headless(makes({waves(0.010)}), replayed, {}));
  return words;
}

TEST(RefusedRecording, WithTimesThatAreNoneIsRefusedByEveryReaderInOneSentence) {
  struct Forgery {
    const char* words;
    double t_s, dt_s;
  };
  constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  for (const auto& forged : {Forgery{"times that are not finite at tick 40", 0.1, kNotANumber},
                             {"times that are not finite at tick 40", 0.1, -kUnbounded},
                             {"times that are not finite at tick 40", kUnbounded, 0.001},
                             {"a negative period at tick 40", 0.1, -0.001},
                             {"times that do not increase at tick 41", 1e9, 0.001},
                             {"times that do not increase at tick 40", -1.0, 0.001}}) {
    const auto file = altered(one_touch(), "times.rec", [&](device::Recording& recording) {
      recording.ticks[40].dt_s = forged.dt_s;
      if (forged.t_s != 0.1) recording.ticks[40].t_s = forged.t_s;
    });
    for (const std::string& words : refusals(file))
      EXPECT_EQ(words, std::string("is a recording with ") + forged.words);
  }
}

TEST(RefusedRecording, WithAHeaderThatIsNoneIsRefusedByEveryReaderInOneSentence) {
  struct Forgery {
    const char* from;
    const char* to;
    const char* words;
  };
  for (const auto& forged :
       {Forgery{"\"max_force_N\":3.3", "\"max_force_N\":-3.3", "greatest force"},
        {"\"max_force_N\":3.3", "\"max_force_N\":1e6", "greatest force"},
        {"\"max_force_N\":null", "\"max_force_N\":1e6", "greatest force"},
        {"\"max_rise_time_s\":0.0", "\"max_rise_time_s\":1e6, \"of\":0.0", "greatest rise time"},
        {"\"max_torque_Nm\":0.0", "\"max_torque_Nm\":-1.0", "greatest torque"},
        {"\"mass_kg\":0.1", "\"mass_kg\":0.0", "mass"},
        {"\"mass_kg\":0.1", "\"mass_kg\":1e6", "mass"},
        {"\"rate_hz\":1000.0", "\"rate_hz\":0.0", "a loop rate of 0.0"},
        {"\"ramp_up_s\":0.25", "\"ramp_up_s\":-1.0", "ramp up"},
        {"\"position_resolution_m\":", "\"position_resolution_m\":-", "resolution"},
        {"\"degrees_of_freedom\":3", "\"degrees_of_freedom\":[]", "traits"},
        {"\"seed\":", "\"seed\":-", "cannot be read"}}) {
    const auto file = altered(one_touch(), "header.rec", [&](device::Recording& recording) {
      const auto at = recording.header_json.find(forged.from);
      ASSERT_NE(at, std::string::npos) << forged.from << recording.header_json;
      recording.header_json.replace(at, std::string(forged.from).size(), forged.to);
    });
    const auto words = refusals(file);
    ASSERT_FALSE(words.empty());
    for (const std::string& one : words) EXPECT_EQ(one, words.front());
    EXPECT_NE(words.front().find(forged.words), std::string::npos) << words.front();
  }
}

TEST(RefusedRecording, OfFormat1IsOneWithAnInvalidRate) {
  for (const std::string rate : {"0", "-1000", "1e300"}) {
    const auto file = in_temp("rate.rec");
    ASSERT_TRUE((*device::RecordingWriter::create(
                     file, R"({"format":1,"made_by":"palpable","seed":1,"rate_hz":)" + rate + "}"))
                    ->finish(0));
    const auto report = check_recording(file, {}, {});
    ASSERT_FALSE(report) << rate;
    EXPECT_NE(report.error().message.find("rate"), std::string::npos) << report.error().message;
  }
}

}  // namespace
}  // namespace palpable::session
