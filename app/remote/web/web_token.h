#pragma once

#include <filesystem>
#include <string>

namespace ergodome {

//! 128 random bits in 32 hexadecimal digits, from the system's generator.
std::string new_web_token();

//! A token that a person chose: 16 to 128 letters, digits, - . _ ~, which need no escape in a URL or cookie. Throws Error otherwise.
std::string checked_web_token(const std::string& token, const std::string& place);

//! The token in a file; where there is none, one is made and written there for the owner's eyes alone (mode 0600).
std::string web_token_in(const std::filesystem::path& file);

//! Returns what is wrong with the permissions of a token's file, and the remedy: empty where only its owner may read it.
std::string web_token_exposure(const std::filesystem::path& file);

}  // namespace ergodome
