#pragma once

#include <cstddef>

namespace ergodome {

//! Makes the process keep freed memory for later allocations: successive pictures need the same
//! amount, and mapping new pages may take longer than filling them. Call once, at startup.
void keep_freed_memory();

//! Allocates uninitialized memory for large arrays, with huge pages if available. Throws
//! std::bad_alloc.
void* take_large_block(std::size_t bytes);

//! Releases such memory, or keeps it for the next request of the same size, within bounds.
void return_large_block(void* memory, std::size_t bytes) noexcept;

//! Returns the number of kept blocks.
std::size_t kept_large_blocks();

}  // namespace ergodome
