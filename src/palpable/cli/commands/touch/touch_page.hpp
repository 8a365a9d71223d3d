// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/commands/touch/touch_plan.hpp"

namespace palpable::cli {

/// A touch with the page in the browser, until the user ends it.
Result<Answer> touch_with_page(const TouchArguments& arguments, const TouchPlan& plan, Console& console);

}  // namespace palpable::cli
