// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/agreement.hpp"

#include "palpable/vision/text/compared_form.hpp"

#include <algorithm>
#include <string_view>

namespace palpable::vision {
namespace {

/// Whether a word of UTF-8 is one letter, digit or mark.
bool is_single_letter(std::string_view word) {
  constexpr unsigned kFollows = 0xC0, kIsFollowing = 0x80;
  return std::count_if(word.begin(), word.end(), [](char c) {
           return (static_cast<unsigned char>(c) & kFollows) != kIsFollowing;
         }) == 1;
}

/// The words but for a first and a last one of a single letter.
std::string_view without_single_letters(std::string_view words) {
  const std::size_t first = words.find(' ');
  if (first != words.npos && is_single_letter(words.substr(0, first))) words.remove_prefix(first + 1);
  const std::size_t last = words.rfind(' ');
  if (last != words.npos && is_single_letter(words.substr(last + 1))) words = words.substr(0, last);
  return words;
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
  std::vector<ReadingVote> votes = votes_of_forms(readings);
  for (ReadingVote& vote : votes) {
    const std::string form = compared_form(without_single_letters(vote.best.text));
    const auto bare =
        std::find_if(votes.begin(), votes.end(), [&](const ReadingVote& v) { return v.form == form; });
    if (bare != votes.end() && &*bare != &vote && bare->count >= vote.count) add_vote(*bare, vote);
  }
  drop_added(votes);
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
