#include "app/player/recording/numbered_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <string>
#include <string_view>

#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Format of the numbers, like those of frames: files sort by name, and a year or a date is not
//! mistaken for a number.
constexpr std::size_t number_digits = 6;
constexpr long max_number = 999'999;

std::filesystem::path folder_of(const std::filesystem::path& record) {
  return record.has_parent_path() ? record.parent_path() : std::filesystem::path(".");
}

//! Returns the existing recordings by number. Throws Error if the folder cannot be read.
std::multimap<long, std::filesystem::path> records_of(const std::filesystem::path& record) {
  std::multimap<long, std::filesystem::path> found;
  std::error_code problem;
  std::filesystem::directory_iterator each(folder_of(record), problem);
  for (; !problem && each != std::filesystem::directory_iterator(); each.increment(problem)) {
    if (const std::optional<long> number = record_number(record, each->path())) {
      found.emplace(*number, each->path());
    }
  }
  if (problem) {
    throw Error(folder_of(record).string(), "cannot be read: " + problem.message(),
                "check the folder and its permissions, or record to another folder");
  }
  return found;
}

}  // namespace

std::optional<long> record_number(const std::filesystem::path& record, const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  const std::string before = record.stem().string() + "-";
  const std::string after = record.extension().string();
  if (!name.starts_with(before) || !name.ends_with(after) || name.size() < before.size() + after.size()) {
    return std::nullopt;
  }
  const std::string_view digits =
      std::string_view(name).substr(before.size(), name.size() - before.size() - after.size());
  if (digits.size() != number_digits || !std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; })) {
    return std::nullopt;
  }
  long number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

std::filesystem::path next_record(const std::filesystem::path& record) {
  const auto there = records_of(record);
  const long number = there.empty() ? 1 : there.rbegin()->first + 1;
  if (number > max_number) {
    throw Error(there.rbegin()->second.string(), "has the highest possible number", "choose another --record name");
  }
  std::filesystem::path next = record;
  next.replace_filename(fmt::format("{}-{:06}{}", record.stem().string(), number, record.extension().string()));
  return next;
}

void remove_oldest_records(const std::filesystem::path& record, std::size_t maximum) {
  const auto there = records_of(record);
  std::size_t left = there.size();
  for (const auto& [number, file] : there) {
    if (left-- <= maximum) {
      return;
    }
    std::error_code stays;
    std::filesystem::remove(file, stays);
  }
}

}  // namespace ergodome
