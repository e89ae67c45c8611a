#include "app/commands/render/numbered_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

namespace ergodome {

namespace {

namespace fs = std::filesystem;

//! Parses the number in NAME_000001... and returns it counted from 0; nothing if `file` does not
//! begin so.
std::optional<int> number_in_name(const std::string& file, const std::string& name) {
  if (!file.starts_with(name + "_")) {
    return std::nullopt;
  }
  const char* const begin = file.data() + name.size() + 1;
  int number = 0;
  const auto [end, problem] = std::from_chars(begin, file.data() + file.size(), number);
  return problem == std::errc() && number > 0 ? std::optional(number - 1) : std::nullopt;
}

void add_numbered(const fs::path& folder, const std::string& name, const std::function<fs::path(int)>& path_of,
                  bool within, std::vector<int>& frames) {
  std::error_code problem;
  for (fs::directory_iterator each(folder, problem), end; !problem && each != end; each.increment(problem)) {
    const std::optional<int> number = number_in_name(each->path().filename().string(), name);
    std::error_code no_kind;
    if (number && path_of(*number) == each->path()) {
      frames.push_back(*number);
    } else if (number && within && each->is_directory(no_kind)) {
      add_numbered(each->path(), name, path_of, false, frames);
    }
  }
}

}  // namespace

std::vector<int> numbered_frames(const fs::path& folder, const std::string& name,
                                 const std::function<fs::path(int)>& path_of) {
  std::vector<int> frames;
  add_numbered(folder, name, path_of, true, frames);
  std::ranges::sort(frames);
  return frames;
}

std::string frame_ranges(const std::vector<int>& frames) {
  constexpr int max_listed = 8;
  std::string text;
  int listed = 0;
  for (std::size_t begin = 0; begin < frames.size();) {
    std::size_t end = begin + 1;
    while (end < frames.size() && frames[end] == frames[end - 1] + 1) {
      ++end;
    }
    if (listed++ == max_listed) {
      return text + ", ...";
    }
    text += text.empty() ? "" : ", ";
    text += end - begin == 1 ? std::to_string(frames[begin] + 1)
                             : fmt::format("{}:{}", frames[begin] + 1, frames[end - 1] + 1);
    begin = end;
  }
  return text;
}

}  // namespace ergodome
