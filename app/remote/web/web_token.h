#pragma once

#include <filesystem>
#include <string>

namespace ergodome {

//! Returns a new token: 128 random bits from the system's generator, as 32 hexadecimal digits.
std::string new_web_token();

//! Returns a token chosen by the user: 16 to 128 letters, digits, - . _ ~, which need no escape in
//! a URL or cookie. Throws Error for other tokens.
std::string checked_web_token(const std::string& token, const std::string& location);

//! Returns the token in a file. If the file is missing, writes a new token to it, readable only by
//! its owner (mode 0600).
std::string web_token_in(const std::filesystem::path& file);

//! Returns what is wrong with the permissions of a token's file, and the remedy; empty if only its
//! owner can read it.
std::string web_token_exposure(const std::filesystem::path& file);

}  // namespace ergodome
