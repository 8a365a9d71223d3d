// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/page/protocol.gen.hpp"
#include "palpable/session/touch/head_feed.hpp"

#include <chrono>

namespace palpable::page {

/// What is new of a viewer's head as the pages are told of it at `now`; a place beyond the protocol's limits
/// is none.
protocol::Head page_head(const session::HeadNews& news, std::chrono::steady_clock::time_point now);

}  // namespace palpable::page
