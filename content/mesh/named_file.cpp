#include "content/mesh/named_file.h"

#include <charconv>
#include <string_view>

namespace ergodome {

namespace {

//! A URI's text with its percent-encoded bytes (RFC 3986, 2.1) as they are; what is not of that form stays.
std::string decoded(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned byte = 0;
    const char* const digits = text.data() + i + 1;
    const bool is_code = text[i] == '%' && i + 2 < text.size() &&
                         std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2 && byte != 0;
    plain += is_code ? static_cast<char>(byte) : text[i];
    i += is_code ? 2U : 0U;
  }
  return plain;
}

std::filesystem::path file_inside(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path named = std::filesystem::path(name).lexically_normal();
  if (folder.empty() || named.is_absolute() || named.empty() || *named.begin() == "..") {
    return {};
  }
  std::error_code problem;
  const std::filesystem::path path = folder / named;
  return std::filesystem::is_regular_file(path, problem) ? path : std::filesystem::path();
}

}  // namespace

std::filesystem::path file_of_mesh(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path as_written = file_inside(folder, name);
  return as_written.empty() ? file_inside(folder, decoded(name)) : as_written;
}

}  // namespace ergodome
