// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane {

/// A sanitizer build, which is some ten times slower: flights are shorter then.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

} // namespace terrane
