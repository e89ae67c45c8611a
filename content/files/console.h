#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace ergodome {

//! Console output. Nothing here throws, because failed output must not lose the program's work.
//! Text from files cannot control the terminal: control characters other than line breaks and tabs
//! are printed as escapes.

//! Ensures that descriptors 0 to 2 are open, so that no other file gets one of them, and that
//! writing to a closed pipe is an error instead of a signal. Call it first in the program.
void prepare_console();

//! Prints to the standard output. finish_output() reports failures.
void print_text(std::string_view text);
//! Prints a line to the standard error, after the program's name.
void note_text(std::string_view text);

template <class... Values>
void print_out(fmt::format_string<Values...> format, Values&&... values) {
  print_text(fmt::format(format, std::forward<Values>(values)...));
}
template <class... Values>
void print_note(fmt::format_string<Values...> format, Values&&... values) {
  note_text(fmt::format(format, std::forward<Values>(values)...));
}

//! Flushes the standard output. Returns false if any output was lost; then also prints the reason
//! to the standard error, except for a closed pipe.
bool finish_output();

}  // namespace ergodome
