// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace terrane::test {

/// How often this program has asked for memory with `new` so far, all threads together. Replaces
/// the global operator new, so it is linked once into a test program.
long allocationCount();

} // namespace terrane::test
