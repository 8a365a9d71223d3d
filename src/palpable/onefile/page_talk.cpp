// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/onefile/page_talk.hpp"

#include "palpable/page/page_state.hpp"
#include "palpable/page/protocol.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace palpable::onefile {
namespace {

/// The number of the only page.
constexpr std::int64_t kPage = 1;
constexpr double kRest_s = 1.0;

}  // namespace

PageTalk::PageTalk(BrowserTouch& touch) : touch_(touch), changes_(touch) { send(changes_.everything(kPage)); }

void PageTalk::receive(std::string_view text) {
  const auto message = page::protocol::parse_from_page(text);
  if (!message) return;
  quiet_s_ = 0.0;
  const describe::LanguageScope scope(language_);
  std::visit([this](const auto& m) { handle(m); }, *message);
}

void PageTalk::handle(const page::protocol::Ask& ask) { send({page::text_frame(touch_.answer(ask))}); }

void PageTalk::handle(const page::protocol::LookAround& question) {
  send({page::text_frame(touch_.around(question))});
}

void PageTalk::handle(const page::protocol::Language& language) {
  language_ = describe::language_from(language.language).value_or(language_);
}

bool PageTalk::advance(double seconds) {
  const describe::LanguageScope scope(language_);
  touch_.advance(seconds);
  auto state = touch_.state();
  for (auto& probe : state.probes) probe.page = kPage;
  for (const auto& notice : changes_.notices()) send({page::text_frame(notice)});
  send(changes_.changes());
  const bool moved = !page::nearly_equal(state, sent_);
  quiet_s_ = moved ? 0.0 : quiet_s_ + seconds;
  if (moved) {
    send({page::text_frame(state)});
    sent_ = std::move(state);
  }
  return quiet_s_ < kRest_s;
}

page::SharedFrame PageTalk::take() {
  if (waiting_.empty()) return nullptr;
  auto frame = std::move(waiting_.front());
  waiting_.pop_front();
  return frame;
}

void PageTalk::send(const std::vector<page::SharedFrame>& frames) {
  waiting_.insert(waiting_.end(), frames.begin(), frames.end());
}

}  // namespace palpable::onefile
