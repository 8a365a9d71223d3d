// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/shelf/make_words.hpp"

#include <gtest/gtest.h>

namespace palpable::page::shelf {
namespace {

using Words = std::vector<std::string>;

protocol::Make wanted(const std::string& what) {
  protocol::Make wanted;
  wanted.what = what;
  return wanted;
}

TEST(MakeWords, SayWhatThePersonSaid) {
  EXPECT_EQ(make_words(wanted("decide"), {"/f/a.palp"})->words, (Words{"make", "/f/a.palp"}));
  EXPECT_EQ(make_words(wanted("drawing"), {"/f/a.png"})->words,
            (Words{"make", "/f/a.png", "--kind=picture", "--as=contours"}));
  const auto pair = make_words(wanted("pair"), {"/f/a.png", "/f/b.png"});
  EXPECT_EQ(pair->words, (Words{"make", "/f/a.png", "/f/b.png", "--kind=stereo"}));
  EXPECT_EQ(pair->quick_words.back(), "--method=fast") << "touched while the best scene is made";
}

TEST(MakeWords, PassOptionsAsValuesThatCannotBeTakenForOptions) {
  auto all = wanted("pair");
  all.title = "--output=/etc/passwd\n";
  all.size_mm = 200.0;
  all.exaggerate = 1.5;
  all.ground = "remove";
  all.background = "keep";
  all.moved_mm = 65.0;
  EXPECT_EQ(
      make_words(all, {"/f/a.png", "/f/b.png"})->words,
      (Words{"make", "/f/a.png", "/f/b.png", "--kind=stereo", "--title=--output=/etc/passwd",
             "--size=200x200x30", "--exaggerate=1.5", "--moved=65", "--ground=remove", "--background=keep"}));
}

TEST(MakeWords, RefuseWhatDoesNotFit) {
  EXPECT_EQ(make_words(wanted("pair"), {"/f/a.png"}).error().sentence(),
            "a pair is two photographs: the left one and the right one");
  EXPECT_FALSE(make_words(wanted("drawing"), {"/f/a.png", "/f/b.png"}));
  EXPECT_FALSE(make_words(wanted("anything"), {"/f/a.png"}));
  EXPECT_FALSE(make_words(wanted("decide"), {}));
  auto ground = wanted("depth");
  ground.ground = "keep --output x";
  EXPECT_FALSE(make_words(ground, {"/f/a.png"}));
}

}  // namespace
}  // namespace palpable::page::shelf
