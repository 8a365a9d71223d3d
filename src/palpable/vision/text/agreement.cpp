// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/agreement.hpp"

#include "palpable/vision/text/compared_form.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace palpable::vision {
namespace {

/// How many letters and digits a word of UTF-8 has; marks of Latin-1 (U+00A0 ... U+00BF) and quotation marks
/// are none.
int letters_in(std::string_view word) {
  constexpr unsigned kFollows = 0xC0, kIsFollowing = 0x80, kLatinMarks = 0xC2, kMarks = 0xE2;
  return static_cast<int>(std::count_if(word.begin(), word.end(), [](char c) {
    const auto u = static_cast<unsigned char>(c);
    if (u < kIsFollowing) return std::isalnum(u) != 0;
    return (u & kFollows) != kIsFollowing && u != kLatinMarks && u != kMarks;
  }));
}

/// The words but for first and last ones of at most a single letter.
std::string_view without_single_letters(std::string_view words) {
  for (std::size_t end = words.find(' '); end != words.npos && letters_in(words.substr(0, end)) <= 1;
       end = words.find(' '))
    words.remove_prefix(end + 1);
  for (std::size_t at = words.rfind(' '); at != words.npos && letters_in(words.substr(at + 1)) <= 1;
       at = words.rfind(' '))
    words = words.substr(0, at);
  while (!words.empty() && std::ispunct(static_cast<unsigned char>(words.back())) != 0)
    words.remove_suffix(1);
  return words;
}

/// The readings, without single letters before and after the words where at least as many readings do not
/// have the same ones.
std::vector<Reading> without_marks_beside(std::vector<Reading> readings) {
  std::vector<std::string> forms, bare;
  for (const Reading& reading : readings) {
    forms.push_back(compared_form(reading.text));
    bare.push_back(compared_form(without_single_letters(reading.text)));
  }
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const auto same = std::count(forms.begin(), forms.end(), forms[i]);
    if (forms[i] != bare[i] && std::count(bare.begin(), bare.end(), bare[i]) >= 2 * same)
      readings[i].text = without_single_letters(readings[i].text);
  }
  return readings;
}

/// A form with one letter for all thin ones.
std::string alike_form(std::string form) {
  constexpr std::string_view kThin = "ij1";
  for (char& c : form)
    if (kThin.find(c) != kThin.npos) c = 'l';
  return form;
}

/// `vote` becomes a part of `into`.
void add_vote(ReadingVote& into, ReadingVote& vote) {
  into.count += vote.count;
  into.weight += vote.weight;
  vote.count = 0;
}

void drop_added(std::vector<ReadingVote>& votes) {
  std::erase_if(votes, [](const ReadingVote& vote) { return vote.count == 0; });
}

/// The votes for each exact form.
std::vector<ReadingVote> votes_of_forms(const std::vector<Reading>& readings) {
  std::vector<ReadingVote> votes;
  for (const Reading& reading : readings) {
    if (reading.text.empty()) continue;
    const std::string form = compared_form(reading.text);
    auto vote =
        std::find_if(votes.begin(), votes.end(), [&](const ReadingVote& v) { return v.form == form; });
    if (vote == votes.end()) vote = votes.insert(votes.end(), {form, {}, 0, 0.0});
    if (reading.confidence > vote->best.confidence) vote->best = reading;
    ++vote->count;
    vote->weight += reading.confidence * reading.confidence;
  }
  return votes;
}

}  // namespace

std::vector<ReadingVote> votes_of_readings(const std::vector<Reading>& readings) {
  std::vector<ReadingVote> votes = votes_of_forms(without_marks_beside(readings));
  std::stable_sort(votes.begin(), votes.end(),
                   [](const ReadingVote& a, const ReadingVote& b) { return a.weight > b.weight; });
  for (std::size_t k = 1; k < votes.size(); ++k)
    for (std::size_t i = 0; i < k && votes[k].count > 0; ++i)
      if (votes[i].count > 0 && alike_form(votes[i].form) == alike_form(votes[k].form))
        add_vote(votes[i], votes[k]);
  drop_added(votes);
  return votes;
}

}  // namespace palpable::vision
