#pragma once

#include <string>

namespace ergodome {

//! Asks all readers of files to give up, on whatever thread: the program is about to end. Safe in a signal handler.
void stop_reading() noexcept;

//! Throws Error once stop_reading() was called. Readers call it in their long loops; it costs a load.
void require_reading_goes_on(const std::string& place);

}  // namespace ergodome
