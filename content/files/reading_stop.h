#pragma once

#include <string>

namespace ergodome {

//! Makes all file readers stop, on all threads, because the program is about to end. Safe in a
//! signal handler.
void stop_reading() noexcept;

//! Throws Error after stop_reading() was called. Readers call it in long loops; it costs one atomic
//! load.
void require_reading_goes_on(const std::string& place);

}  // namespace ergodome
