// SPDX-License-Identifier: BSD-3-Clause
#include "tools/terrane/allocation_counter.h"

#include <atomic>
#include <cstdlib>
#include <new>

// A program may replace the global operator new; libraries use its version, too. The array and
// nothrow forms of the standard library call this one. Sanitizers have their own, which check more.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)

std::uint64_t countedAllocations() {
    return 0;
}

bool allocationsAreCounted() {
    return false;
}

#else

namespace {
std::atomic<std::uint64_t> allocations{0};
}

std::uint64_t countedAllocations() {
    return allocations.load(std::memory_order_relaxed);
}

bool allocationsAreCounted() {
    return true;
}

void* operator new(std::size_t size) {
    allocations.fetch_add(1, std::memory_order_relaxed);
    if (void* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
    throw std::bad_alloc();
}

void operator delete(void* memory) noexcept {
    std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

#endif
