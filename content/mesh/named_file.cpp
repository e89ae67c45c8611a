#include "content/mesh/named_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string_view>

namespace ergodome {

namespace {

//! Decodes the percent-encoded bytes of a URI (RFC 3986, 2.1). Leaves malformed codes and %00
//! unchanged.
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

//! Returns the path of a folder's entry with this name, ignoring case as Windows does. Returns an
//! empty path if there is no such entry.
std::filesystem::path entry_in_any_case(const std::filesystem::path& folder, const std::string& name) {
  const auto lower = [](std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  const std::string wanted = lower(name);
  std::error_code problem;
  std::filesystem::directory_iterator each(folder, problem);
  for (; !problem && each != std::filesystem::directory_iterator(); each.increment(problem)) {
    if (lower(each->path().filename().string()) == wanted) {
      return each->path();
    }
  }
  return {};
}

std::filesystem::path file_inside(const std::filesystem::path& folder, const std::string& name) {
  // The operating system's limit on paths.
  constexpr std::size_t longest_name = 4096;
  if (name.size() > longest_name) {
    return {};
  }
  const std::filesystem::path named = std::filesystem::path(name).lexically_normal();
  if (folder.empty() || named.is_absolute() || named.empty() || *named.begin() == "..") {
    return {};
  }
  std::error_code problem;
  std::filesystem::path path = folder / named;
  if (std::filesystem::is_regular_file(path, problem)) {
    return path;
  }
  std::filesystem::path at = folder;
  for (const std::filesystem::path& part : named) {
    at = at.empty() ? at : entry_in_any_case(at, part.string());
  }
  return !at.empty() && std::filesystem::is_regular_file(at, problem) ? at : std::filesystem::path();
}

//! Replaces backslashes by slashes. Reduces a path that begins with a drive, a server or the root
//! to its file name.
std::string name_beside_mesh(std::string name) {
  std::ranges::replace(name, '\\', '/');
  const bool drive = name.size() > 2 && std::isalpha(static_cast<unsigned char>(name[0])) != 0 && name[1] == ':';
  return drive || name.starts_with('/') ? std::filesystem::path(name).filename().string() : name;
}

//! Converts a name from Latin-1, which old Windows programs write, to UTF-8.
std::string from_latin_1(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80U) {
      text += c;
    } else {
      text += static_cast<char>(0xC0U | (byte >> 6U));
      text += static_cast<char>(0x80U | (byte & 0x3FU));
    }
  }
  return text;
}

}  // namespace

std::filesystem::path file_of_mesh(const std::filesystem::path& folder, const std::string& name) {
  for (const std::string& each : {name, decoded(name), name_beside_mesh(name), from_latin_1(name_beside_mesh(name))}) {
    if (std::filesystem::path found = file_inside(folder, each); !found.empty()) {
      return found;
    }
  }
  return {};
}

bool leads_outside(const std::string& name) {
  const std::filesystem::path named = std::filesystem::path(name_beside_mesh(name)).lexically_normal();
  return !named.empty() && *named.begin() == "..";
}

}  // namespace ergodome
