#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace ergodome {

//! What the program prints is never worth losing its work for: nothing here throws. Text from files cannot change the
//! terminal: control characters except line breaks and tabs are printed by their numbers.

//! Makes sure that descriptors 0 to 2 are open, so that no file of ours gets one of them, and that a closed pipe is an error
//! of writing and not the end of the program. Call it first.
void prepare_console();

//! Prints to the standard output. finish_output() reports what could not be written.
void print_text(std::string_view text);
//! Prints a line to the standard error, behind the program's name.
void note_text(std::string_view text);

template <class... Values>
void print_out(fmt::format_string<Values...> format, Values&&... values) {
  print_text(fmt::format(format, std::forward<Values>(values)...));
}
template <class... Values>
void print_note(fmt::format_string<Values...> format, Values&&... values) {
  note_text(fmt::format(format, std::forward<Values>(values)...));
}

//! Flushes the standard output. Returns false where something printed is lost, with a line on the standard error, unless the
//! reader of a pipe just had enough.
bool finish_output();

}  // namespace ergodome
