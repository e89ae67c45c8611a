#pragma once

#include <cstddef>

namespace ergodome {

//! Lets the process keep memory that it frees, for what it allocates next: pictures that come one after the other need as much each time,
//! and being given pages anew may take longer than filling them. Call it once, at the start.
void keep_freed_memory();

//! Memory for large arrays, in large pages where there are any, not filled. Throws std::bad_alloc.
void* take_large_block(std::size_t bytes);

//! Takes such memory back, and keeps it for the next that asks for as much, within bounds.
void return_large_block(void* memory, std::size_t bytes) noexcept;

//! How many blocks are kept.
std::size_t kept_large_blocks();

}  // namespace ergodome
