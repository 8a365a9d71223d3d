// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/scene_file.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include "made_scene.hpp"
#include "program.hpp"
#include <gmock/gmock.h>

namespace palpable::test {
namespace {

using ::testing::HasSubstr;

class MakeAgain : public MadeScene {};

TEST_F(MakeAgain, AMadeSceneStatesHowItWasMade) {
  ASSERT_EQ(palpable({"make", in("left.png"), in("right.png"), "-o", in("first.palp"), "--size", "80x80x12",
                      "--material", "0:friction=0.4", "--seed", "7", "--engrave"})
                .exit_code,
            0);
  const auto source = palpable({"info", in("first.palp"), "--json"}).json()["source"];
  EXPECT_EQ(source["command"][0], "make");
  EXPECT_EQ(source["command"][1], in("left.png"));
  for (const char* option : {"--size=80x80x12", "--material=0:friction=0.4", "--seed=7", "--engrave"})
    EXPECT_THAT(source["command"], testing::Contains(option));
  EXPECT_THAT(source["command"], testing::Not(testing::Contains(HasSubstr("first.palp"))));
  ASSERT_EQ(source["files"].size(), 2U);
  EXPECT_EQ(source["files"][0]["bytes"], std::filesystem::file_size(in("left.png")));
  EXPECT_EQ(source["files"][0]["sha256"].get<std::string>().size(), 64U);
  const Outcome again = palpable({"make", "--again", in("first.palp"), "-o", in("second.palp"), "--json"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.json()["identical"], true);
  EXPECT_EQ(read_text(in("first.palp")), read_text(in("second.palp")));
}

TEST_F(MakeAgain, ASceneWhoseFilesMovedOrChangedIsMadeAgainOrRefused) {
  const std::string elsewhere = in("moved/");
  std::filesystem::create_directories(elsewhere);
  std::filesystem::copy_file(in("left.png"), elsewhere + "l.png");
  std::filesystem::copy_file(in("right.png"), elsewhere + "r.png");
  ASSERT_EQ(palpable({"make", elsewhere + "l.png", elsewhere + "r.png", "-o", in("m.palp")}).exit_code, 0);
  for (const char* name : {"l.png", "r.png"}) std::filesystem::rename(elsewhere + name, in(name));
  const Outcome moved = palpable({"make", "--again", in("m.palp"), "-o", in("n.palp"), "--json"});
  ASSERT_EQ(moved.exit_code, 0) << moved.err;
  // Only its source names other places.
  EXPECT_EQ(moved.json()["identical"], true);
  EXPECT_EQ(palpable({"info", in("n.palp"), "--json"}).json()["source"]["command"][1], in("l.png"));
  std::filesystem::rename(in("r.png"), elsewhere + "r.png");
  const Outcome missing = palpable({"make", "--again", in("m.palp"), "-o", in("o.palp")});
  EXPECT_EQ(missing.exit_code, 0) << "each file is looked for by itself";
  std::filesystem::copy_file(in("left.png"), elsewhere + "r.png",
                             std::filesystem::copy_options::overwrite_existing);
  const Outcome changed = palpable({"make", "--again", in("m.palp"), "-o", in("p.palp")});
  EXPECT_EQ(changed.exit_code, 3);
  EXPECT_TRUE(is_one_sentence(changed.err));
  EXPECT_THAT(changed.err, HasSubstr("has another content"));
  EXPECT_FALSE(std::filesystem::exists(in("p.palp")));
  EXPECT_EQ(palpable({"make", "--again", in("m.palp"), "-o", in("m.palp")}).exit_code, 2);
  EXPECT_EQ(palpable({"make", "--again", in("m.palp"), "-o", in("q.palp"), "--engrave"}).exit_code, 2);
}

TEST_F(MakeAgain, NamesThatLookLikeOptionsAreKeptAndThoseThatAreNotUtf8AreNot) {
  const std::filesystem::path here = std::filesystem::current_path();
  std::filesystem::current_path(in(""));
  std::filesystem::copy_file("left.png", "-l.png");
  std::filesystem::copy_file("left.png", "\xFF.png");
  EXPECT_EQ(palpable({"make", "-o", "dash.palp", "--", "-l.png"}).exit_code, 0);
  const Outcome dash = palpable({"make", "--again", "dash.palp", "-o", "dash2.palp", "--json"});
  EXPECT_EQ(dash.exit_code, 0) << dash.err;
  EXPECT_EQ(palpable({"make", "-o", "bytes.palp", "\xFF.png"}).exit_code, 0);
  const Outcome bytes = palpable({"make", "--again", "bytes.palp", "-o", "bytes2.palp"});
  EXPECT_EQ(bytes.exit_code, 3);
  EXPECT_THAT(bytes.err, HasSubstr("does not state how it was made"));
  std::filesystem::current_path(here);
}

TEST_F(MakeAgain, ASceneCannotHaveAnotherFileWrittenThanTheNamedOne) {
  auto file = formats::read_scene(in("a.palp"));
  ASSERT_TRUE(file);
  const std::string left = in("left.png"), right = in("right.png"), prey = in("prey.csv");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"export", in("a.palp"), "--output=" + prey},
        {"make", left, right, "--report=" + prey},
        {"make", left, right, "--output=" + prey},
        {"make", in("film.mp4"), "--poses", prey},
        {"make", left, right, "--no-such-option"},
        {"make", left, right, "--help"},
        {"make", left, right, "--describe=@" + in("a.palp")},
        {"make", "--again=" + in("hostile.palp")},
        {"make", "--again", in("hostile.palp")},
        {"make"}}) {
    file->scene.source.command = command;
    ASSERT_TRUE(formats::write_scene(in("hostile.palp"), file->scene));
    const Outcome outcome = palpable({"make", "--again", in("hostile.palp"), "-o", in("h.palp")});
    EXPECT_THAT(outcome.exit_code, testing::AnyOf(2, 3)) << outcome.err;
    EXPECT_TRUE(is_one_sentence(outcome.err));
    EXPECT_FALSE(std::filesystem::exists(prey));
    EXPECT_FALSE(std::filesystem::exists(in("h.palp")));
  }
}

}  // namespace
}  // namespace palpable::test
