// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Wrong on purpose: its folder is no module.
