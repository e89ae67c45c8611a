#include "app/remote/web/web_token.h"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>

#include "app/remote/common/net_address.h"
#include "content/files/atomic_file.h"
#include "content/files/whole_file.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr std::size_t shortest_token = 16;
constexpr std::size_t longest_token = 128;

//! Writes a file that only its owner can read, from its first byte on.
void write_privately(const std::filesystem::path& file, const std::string& text) {
  write_atomically(file, [&](const std::filesystem::path& partial) {
    const Descriptor handle(::open(partial.c_str(), O_WRONLY | O_CLOEXEC));
    if (!handle.is_open() || ::fchmod(handle.get(), 0600) != 0 ||
        ::write(handle.get(), text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
      throw Error(file.string(), std::string("cannot be written: ") + std::strerror(errno),
                  "choose another file with --web-token-file");
    }
  });
}

}  // namespace

std::string new_web_token() {
  std::array<unsigned char, 16> bytes = {};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw Error("status page", std::string("cannot generate a random token: ") + std::strerror(errno),
                "give a token with --web-token");
  }
  constexpr std::string_view digits = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : bytes) {
    token += digits[byte >> 4U];
    token += digits[byte & 0xFU];
  }
  return token;
}

std::string checked_web_token(const std::string& token, const std::string& location) {
  constexpr std::string_view others = "-._~";
  const auto fits = [&](unsigned char c) {
    return std::isalnum(c) != 0 || others.find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (token.size() < shortest_token || token.size() > longest_token || !std::all_of(token.begin(), token.end(), fits)) {
    throw Error(location, "is not a valid token",
                "give 16 to 128 letters, digits or characters of - . _ ~, or leave it out to generate one");
  }
  return token;
}

std::string web_token_in(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    std::string token = new_web_token();
    write_privately(file, token + "\n");
    return token;
  }
  std::string token = read_whole_file(file, 4096, "a file with a token in its first line");
  token.resize(std::min(token.find_first_of("\r\n"), token.size()));
  return checked_web_token(token, file.string());
}

std::string web_token_exposure(const std::filesystem::path& file) {
  using std::filesystem::perms;
  std::error_code problem;
  const perms found = std::filesystem::status(file, problem).permissions();
  const bool exposed = !problem && (found & (perms::group_all | perms::others_all)) != perms::none;
  return exposed ? Error(file.string(), "other users of this machine can read the token",
                         "run chmod 600 " + file.string() + ", and replace the token if others may have read it")
                       .what()
                 : "";
}

}  // namespace ergodome
