// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/page/share_host.hpp"

#include <string>
#include <vector>

namespace palpable::page {

/// A self-signed certificate for these IP addresses with a new key on the curve P-256, valid from an hour ago
/// for two days. Nothing is written to a file. Errors: invalid_input for what is no address; failed, if
/// OpenSSL fails.
Result<ServerCertificate> make_certificate(const std::vector<std::string>& addresses);

}  // namespace palpable::page
