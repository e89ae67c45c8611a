#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ergodome {

//! Returns a text as one word of a shell: unchanged if the shell takes it literally, otherwise in
//! single quotes. The text must not contain a zero byte.
std::string shell_word(std::string_view text);

//! Returns words of a shell, separated by spaces.
std::string shell_words(const std::vector<std::string>& words);

}  // namespace ergodome
