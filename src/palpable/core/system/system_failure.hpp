// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <system_error>

namespace palpable {

/// The system's words for an error number (errno), as an Error of the code `failed` without a place.
inline Error system_failure(int number) {
  return {ErrorCode::failed, std::generic_category().message(number), {}};
}

}  // namespace palpable
