// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

/// Calls of operator new since the program started, in all threads and libraries.
std::uint64_t countedAllocations();
