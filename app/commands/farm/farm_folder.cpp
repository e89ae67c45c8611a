#include "app/commands/farm/farm_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "content/files/atomic_file.h"
#include "content/files/whole_file.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

constexpr const char* run_file = "run.json";
constexpr const char* choices_file = "choices.json";
constexpr std::size_t max_farm_file_bytes = std::size_t{16} << 20U;

nlohmann::json json_of(const FarmStep& step) {
  return {{"name", step.name}, {"description", step.description}, {"tasks", step.tasks}};
}

FarmStep step_of(const nlohmann::json& json) {
  FarmStep step;
  step.name = json.at("name");
  step.description = json.at("description");
  step.tasks = json.at("tasks").get<std::vector<std::string>>();
  return step;
}

nlohmann::json read_json(const fs::path& file) {
  try {
    return nlohmann::json::parse(read_whole_file(file, max_farm_file_bytes, "run ergodome farm again"));
  } catch (const nlohmann::json::exception& problem) {
    throw Error(file.string(), fmt::format("is damaged ({})", problem.what()),
                "remove it, and run ergodome farm again");
  }
}

}  // namespace

FarmFolder::FarmFolder(const fs::path& out) : path_(fs::absolute(out).lexically_normal() / "farm") {}

int FarmFolder::newest_run() const {
  int newest = 0;
  std::error_code problem;
  for (fs::directory_iterator each(path_ / "runs", problem), end; !problem && each != end; each.increment(problem)) {
    const std::string name = each->path().filename().string();
    int number = 0;
    const auto [rest, failed] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (failed == std::errc() && rest == name.data() + name.size()) {
      newest = std::max(newest, number);
    }
  }
  return newest;
}

fs::path FarmFolder::run_folder(int run) const { return path_ / "runs" / fmt::format("{:04}", run); }

void FarmFolder::write_run(int run, const std::string& engine, const FarmPlan& plan, const RunFiles& files) const {
  const fs::path folder = run_folder(run);
  make_folder(folder.parent_path());
  // Two farms that start at the same time must not share a run.
  std::error_code problem;
  if (!fs::create_directory(folder, problem)) {
    throw Error(folder.string(), problem ? "cannot be created: " + problem.message() : "was created by another farm",
                problem ? "check the folder and its permissions" : "wait until the other farm has ended");
  }
  make_folder(folder / "attempts");
  for (const auto& [name, text] : files) {
    write_text_atomically(folder / name, text);
  }
  nlohmann::json json = {{"engine", engine},
                         {"show", plan.name},
                         {"out", plan.out.string()},
                         {"first_frame", plan.film.first + 1},
                         {"last_frame", plan.film.last + 1},
                         {"chunk", plan.chunk},
                         {"steps", nlohmann::json::array()}};
  for (const FarmStep& step : plan.steps) {
    json["steps"].push_back(json_of(step));
  }
  write_text_atomically(folder / run_file, json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

FarmRun newest_farm_run(const fs::path& out) {
  const FarmFolder folder(out);
  FarmRun run;
  run.number = folder.newest_run();
  if (run.number == 0) {
    throw Error(out.string(), "contains no film of ergodome farm", "name the folder that was --out");
  }
  run.folder = folder.run_folder(run.number);
  const fs::path file = run.folder / run_file;
  const nlohmann::json json = read_json(file);
  try {
    run.engine = json.at("engine");
    run.plan.name = json.at("show");
    run.plan.out = fs::absolute(out).lexically_normal();
    run.plan.film = {json.at("first_frame").get<int>() - 1, json.at("last_frame").get<int>() - 1};
    run.plan.chunk = json.at("chunk");
    std::ranges::transform(json.at("steps"), std::back_inserter(run.plan.steps), step_of);
  } catch (const nlohmann::json::exception& problem) {
    throw Error(file.string(), fmt::format("is damaged ({})", problem.what()), "run ergodome farm again");
  }
  return run;
}

std::optional<FilmChoices> stored_choices(const FarmFolder& folder, const std::string& request) {
  std::error_code problem;
  const fs::path file = folder.path() / choices_file;
  if (!fs::exists(file, problem)) {
    return std::nullopt;
  }
  try {
    const nlohmann::json json = read_json(file);
    FilmChoices choices = {json.at("request"), json.at("chunk"), json.at("quality").get<std::vector<std::string>>()};
    return choices.request == request ? std::optional(choices) : std::nullopt;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

void store_choices(const FarmFolder& folder, const FilmChoices& choices) {
  make_folder(folder.path());
  const nlohmann::json json = {{"request", choices.request}, {"chunk", choices.chunk}, {"quality", choices.quality}};
  write_text_atomically(folder.path() / choices_file, json.dump(2) + "\n");
}

}  // namespace ergodome
