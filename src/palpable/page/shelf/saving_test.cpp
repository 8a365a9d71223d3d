// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Scenes of the shelf as files: those that the browser gets, and those that keep what a person has named.
#include "palpable/formats/scene/scene_file.hpp"
#include "palpable/page/shelf/test_shelf.hpp"

#include <gmock/gmock.h>

namespace palpable::page::shelf {
namespace {

namespace fs = std::filesystem;

// Makes scenes as the other tests do, and exports what it was called with.
constexpr const char* kExports =
    "if [ \"$1\" = export ]; then echo \"$*\" > \"$out\"; else cp \"$scene\" \"$out\"; fi";

Json save(const ServedShelf& served, const std::string& scene, const std::string& form,
          const Json& paper = nullptr) {
  return served.end_of(served.tell(
      {{"type", "save_as"}, {"scene", scene}, {"form", form}, {"paper", paper}, {"language", "en"}}));
}

TEST(Saving, GivesTheBrowserASceneAsAnotherFile) {
  ServedShelf served(kExports);
  const Json end = save(served, "sample:one", "swell", "A3");
  ASSERT_EQ(end["state"], "saved") << end;
  ASSERT_EQ(end["saved"].size(), 1U);
  EXPECT_EQ(end["saved"][0]["name"], "One.svg");
  const auto file = served.get(end["saved"][0]["address"]);
  EXPECT_EQ(file.result_int(), 200U);
  EXPECT_THAT(file.body(), testing::MatchesRegex("export .*sample-one.palp --paper A3 -o .*\n"));
  EXPECT_EQ(file["Content-Disposition"], "attachment") << "it must not be a page of this server";
  EXPECT_EQ(file["Content-Type"], "application/octet-stream");
  EXPECT_EQ(file["X-Content-Type-Options"], "nosniff");
  EXPECT_EQ(served.begun, 0) << "nothing is touched";
}

TEST(Saving, GivesTheSceneItself) {
  ServedShelf served(kExports);
  const Json end = save(served, "sample:one", "scene");
  ASSERT_EQ(end["state"], "saved") << end;
  const std::string bytes = served.get(end["saved"][0]["address"]).body();
  const auto read = formats::decode_scene(std::as_bytes(std::span(bytes)));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->scene.title, "A level");
}

TEST(Saving, DoesNotGiveADamagedSceneItself) {
  ServedShelf served(kExports);
  ASSERT_EQ(served.end_of(served.make(served.upload()))["state"], "touching");
  const std::string scene = served.tell({{"type", "look"}})["recent"][0]["scene"];
  std::ofstream(served.folder / "state" / (scene + ".palp")) << "rubbish";
  const Json end = save(served, scene, "scene");
  EXPECT_EQ(end["state"], "failed") << end;
  EXPECT_TRUE(end["saved"].empty());
}

TEST(Saving, GivesEveryFileOfADrawing) {
  ServedShelf served(
      "if [ \"$1\" = export ]; then echo 1 > \"$out\"; echo 2 > \"${out%.svg}-key.svg\"; "
      "else cp \"$scene\" \"$out\"; fi");
  const Json end = save(served, "sample:one", "swell", "A4");
  ASSERT_EQ(end["saved"].size(), 2U) << end;
  EXPECT_EQ(end["saved"][0]["name"], "One.svg") << "the drawing first";
  EXPECT_EQ(end["saved"][1]["name"], "One-key.svg");
  EXPECT_EQ(served.get(end["saved"][0]["address"]).body(), "1\n");
  EXPECT_EQ(served.get(end["saved"][1]["address"]).body(), "2\n");
}

TEST(Saving, SaysWhyItFailed) {
  ServedShelf served(
      "if [ \"$1\" = export ]; then echo \"{\\\"error\\\":\\\"$out: no room\\\"}\" >&3; exit 5; "
      "else cp \"$scene\" \"$out\"; fi");
  const Json end = save(served, "sample:one", "print");
  EXPECT_EQ(end["state"], "failed");
  EXPECT_EQ(end["sentence"], "One.stl: no room");
  EXPECT_TRUE(end["saved"].empty());
}

TEST(Saving, AdmitsOnlyItsOwnBrowserAndGivesNothingElse) {
  ServedShelf served(kExports);
  const std::string address = save(served, "sample:one", "phone")["saved"][0]["address"];
  EXPECT_EQ(served.get(address).result_int(), 200U);
  EXPECT_EQ(ask(served, http::verb::get, address).result_int(), 401U);
  for (const std::string& other :
       {address + "1", address + "/", std::string("/saved/"), std::string("/saved/1"),
        std::string("/saved/1/"), std::string("/saved/-1/0"), std::string("/saved/../../../etc/passwd"),
        std::string("/saved/1/../0"), std::string("/saved/99999999999999999999/0")})
    EXPECT_EQ(served.get(other).result_int(), 404U) << other;
  for (const auto& [scene, form] : {std::pair("sample:one", "words"), std::pair("sample:two", "phone"),
                                    std::pair("../state/x", "scene"), std::pair("sample:one", "--help")})
    EXPECT_EQ(served
                  .post("/shelf", Json{{"type", "save_as"},
                                       {"scene", scene},
                                       {"form", form},
                                       {"paper", nullptr},
                                       {"language", "en"}}
                                      .dump())
                  .result_int(),
              409U)
        << scene << form;
}

TEST(Saving, IsCancelled) {
  ServedShelf served("if [ \"$1\" = export ]; then sleep 1000; else cp \"$scene\" \"$out\"; fi");
  const Json job = served.tell({{"type", "save_as"},
                                {"scene", "sample:one"},
                                {"form", "phone"},
                                {"paper", nullptr},
                                {"language", "en"}});
  EXPECT_EQ(job["state"], "saving");
  EXPECT_EQ(served.end_of(served.tell({{"type", "cancel"}, {"job", job["job"]}}))["state"], "cancelled");
}

TEST(Saving, KeepsTheLastFilesOnly) {
  ServedShelf served(kExports);
  const std::string first = save(served, "sample:one", "phone")["saved"][0]["address"];
  for (int k = 0; k < 3; ++k) save(served, "sample:one", "phone");
  EXPECT_EQ(served.get(first).result_int(), 200U);
  const std::string last = save(served, "sample:one", "phone")["saved"][0]["address"];
  while (served.get(first).result_int() == 200U) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(served.get(last).result_int(), 200U);
  for (int k = 0; k < 20; ++k) served.end_of(served.tell({{"type", "open"}, {"scene", "sample:one"}}));
  EXPECT_EQ(served.get(last).result_int(), 200U) << "touches do not count";
}

models::Scene named(models::Scene scene, const std::string& name) {
  scene.names = {{name, {}, {0.004, 0.004}}};
  return scene;
}

TEST(Saving, KeepsNamesWithTheSceneOfTheShelf) {
  ServedShelf served(kCopies);
  ASSERT_EQ(served.end_of(served.make(served.upload()))["state"], "touching");
  const std::string scene = served.tell({{"type", "look"}})["recent"][0]["scene"];
  ASSERT_TRUE(served.keep(named(*served.touched, "Well")));
  EXPECT_EQ(served.tell({{"type", "look"}})["recent"].size(), 1U);
  ASSERT_EQ(served.end_of(served.tell({{"type", "open"}, {"scene", scene}}))["state"], "touching");
  ASSERT_EQ(served.touched->names.size(), 1U);
  EXPECT_EQ(served.touched->names.front().name, "Well");
}

TEST(Saving, KeepsANamedSampleAmongTheScenesOpenedLately) {
  ServedShelf served(kCopies);
  ASSERT_EQ(served.end_of(served.tell({{"type", "open"}, {"scene", "sample:one"}}))["state"], "touching");
  EXPECT_TRUE(served.tell({{"type", "look"}})["recent"].empty());
  ASSERT_TRUE(served.keep(named(*served.touched, "Well")));
  ASSERT_TRUE(served.keep(named(*served.touched, "Pump")));
  const Json recent = served.tell({{"type", "look"}})["recent"];
  ASSERT_EQ(recent.size(), 1U) << "the second time it has a copy";
  EXPECT_EQ(recent[0]["title"], "A level, with names");
  ASSERT_EQ(served.end_of(served.tell({{"type", "open"}, {"scene", "sample:one"}}))["state"], "touching");
  EXPECT_TRUE(served.touched->names.empty()) << "the sample itself is as it was";
  ASSERT_EQ(served.end_of(served.tell({{"type", "open"}, {"scene", recent[0]["scene"]}}))["state"],
            "touching");
  EXPECT_EQ(served.touched->names.at(0).name, "Pump");
}

TEST(Saving, DoesNotBringBackASceneThatWasRemoved) {
  ServedShelf served(kCopies);
  ASSERT_EQ(served.end_of(served.make(served.upload()))["state"], "touching");
  served.tell({{"type", "forget"}, {"scene", nullptr}});
  EXPECT_FALSE(served.keep(named(*served.touched, "Well")));
  EXPECT_TRUE(served.tell({{"type", "look"}})["recent"].empty());
}

}  // namespace
}  // namespace palpable::page::shelf
