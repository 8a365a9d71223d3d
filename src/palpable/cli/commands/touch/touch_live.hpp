// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/commands/touch/touch_plan.hpp"
#include "palpable/core/work.hpp"

#include <string>
#include <vector>

namespace palpable::cli {

/// Opens the live source that the inputs of the plan name, if they do, and waits for its first frame; its
/// servo then changes from frame to frame. Gives a note on options that have no effect on it. Errors: usage
/// for a live source beside other inputs, or with options that exclude it; as session::open_live_source() and
/// session::LiveFeed::open().
Result<void> open_live(const TouchArguments& arguments, TouchPlan& plan, const Notes& notes,
                       const Work& work);

}  // namespace palpable::cli
