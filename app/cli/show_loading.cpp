#include "app/cli/show_loading.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "app/cli/usage_error.h"
#include "content/files/console.h"
#include "content/objects/object_checks.h"
#include "content/show/animated_show.h"
#include "content/show/reading/show_reader.h"
#include "content/show/stereo_eyes.h"
#include "content/sky/sky_map.h"
#include "kernels/core/error.h"
#include "render/lens/lens_source.h"

namespace ergodome {

namespace {

std::vector<std::string> built_in_shows(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code problem;
  for (const auto& entry : std::filesystem::directory_iterator(folder, problem)) {
    if (entry.path().extension() == ".toml") {
      names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

//! Reads a show file. Turns errors caused by --set into usage errors.
Show read_set_show(const std::filesystem::path& path, const ShowSettings& settings) {
  try {
    return read_show_with_settings(path, settings);
  } catch (const Error& error) {
    if (error.location().starts_with(show_setting_option)) {
      throw UsageError(error.location(), error.problem(), error.remedy());
    }
    throw;
  }
}

}  // namespace

Show load_show(const std::string& name_or_path, const ShowSettings& settings) {
  std::error_code problem;
  // A folder with the name of a built-in show does not hide it.
  if (std::filesystem::exists(name_or_path, problem) && !std::filesystem::is_directory(name_or_path, problem)) {
    return read_set_show(name_or_path, settings);
  }
  const std::filesystem::path folder = built_in_content_folder() / "shows";
  const std::filesystem::path built_in = folder / (name_or_path + ".toml");
  if (name_or_path.find('/') == std::string::npos && std::filesystem::exists(built_in, problem)) {
    return read_set_show(built_in, settings);
  }
  throw Error(name_or_path.empty() ? "\"\"" : name_or_path, "is neither a file nor a built-in show",
              fmt::format("built-in shows: {}", fmt::join(built_in_shows(folder), ", ")));
}

void require_two_eyes(const Show& show, const std::string& option, bool given) {
  if (given && eye_count(show.stereo) == 1) {
    throw UsageError(option, show.name + " is not stereo", "leave it out, or add for example --stereo side_by_side");
  }
}

void report_equal_eyes(const Show& show) {
  if (eye_count(show.stereo) > 1 && !(show_at_most(show).stereo.baseline > 0.0)) {
    print_note("both eyes see the same picture, because stereo.baseline of the show is 0; set it with --baseline");
  }
}

void require_time(const std::string& option, const Show& show, double time_s) {
  if (!(time_s >= 0.0 && time_s <= show.duration_s)) {
    throw UsageError(option, fmt::format("{:.9g} s is outside {}", time_s, show.name),
                     fmt::format("choose from 0 to {:.9g} s", show.duration_s));
  }
}

void require_features(const Show& show) {
  const std::vector<MissingFeature> missing = missing_features(show);
  if (!missing.empty()) {
    throw Error(show.name + ".toml", missing.front().problem, missing.front().remedy);
  }
}

}  // namespace ergodome
