// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/commands/touch/touch_plan.hpp"

namespace palpable::cli {

/// A touch without the page, by a device or a scripted hand, for the seconds of the arguments.
Result<Answer> touch_without_page(const TouchArguments& arguments, const TouchPlan& plan, Console& console);

/// A touch by the keys of the terminal.
Result<Answer> touch_with_keys(const TouchArguments& arguments, const TouchPlan& plan, Console& console);

}  // namespace palpable::cli
