// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

namespace gigaray::python {

/// Error of the library becomes gigaray.Error with the same line and `code`; memory that could not
/// be had, too.
void translate_errors();

}  // namespace gigaray::python
