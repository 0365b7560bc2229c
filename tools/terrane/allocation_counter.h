// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

/// Calls of operator new since the program started, in all threads and libraries. Linked once into
/// a program, it replaces the global operator new.
std::uint64_t countedAllocations();

/// False in sanitizer builds, whose own operator new checks more: the count then stays 0.
bool allocationsAreCounted();
