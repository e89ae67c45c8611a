#include "app/commands/inspect/inspect_trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "app/cli/progress.h"
#include "app/cli/usage_error.h"
#include "content/files/console.h"
#include "content/trajectory/trajectory_reader.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

nlohmann::json summary_of(const StationEntry& station) {
  return {{"t_s", station.time_s},
          {"r", station.r},
          {"theta_deg", station.theta * radian_deg},
          {"bytes", station.bytes},
          {"nodes", station.nodes},
          {"cells", station.leaves},
          {"gap_error_px", station.gap_error_px},
          {"disk_bytes", station.disk_bytes},
          {"disk_gap_error_px", station.disk_gap_error_px}};
}

}  // namespace

bool is_trajectory(const std::filesystem::path& file) {
  std::ifstream from(file, std::ios::binary);
  char first[5] = {};
  from.read(first, sizeof first);
  return from && std::string_view(first, sizeof first) ==
                     "\x89"
                     "ERGO";
}

void require_finished_trajectory(const std::filesystem::path& file) {
  std::filesystem::path part = file;
  part += ".part";
  std::error_code problem;
  if (!std::filesystem::exists(file, problem) && std::filesystem::exists(part, problem)) {
    throw Error(file.string(), "is not finished", "bake the show to the same file again to continue");
  }
}

nlohmann::json summary_of_trajectory(const std::filesystem::path& file) {
  const TrajectoryReader trajectory(file);
  const TrajectoryProvenance& from = trajectory.provenance();
  nlohmann::json summary = {{"file", file.string()},
                            {"bytes", trajectory.file_bytes()},
                            {"spin", from.spacetime.spin},
                            {"budget_px", from.budget_px},
                            {"pixel_arcmin", from.pixel * radian_deg * 60.0},
                            {"derivatives", from.derivatives},
                            {"disk", from.disk},
                            {"code_version", from.code_version},
                            {"show", from.show_text},
                            {"stations", nlohmann::json::array()},
                            {"damaged", nlohmann::json::array()}};
  Progress progress("reading", static_cast<long>(trajectory.stations().size()));
  for (std::size_t i = 0; i < trajectory.stations().size(); ++i) {
    summary["stations"].push_back(summary_of(trajectory.stations()[i]));
    try {
      (void)trajectory.read(i);
      if (trajectory.stations()[i].disk_bytes > 0) {
        (void)trajectory.read_disk(i);
      }
    } catch (const Error& problem) {
      summary["damaged"].push_back(problem.what());
    }
    progress.advance_to(static_cast<long>(i));
  }
  return summary;
}

void print_trajectory(const nlohmann::json& summary) {
  constexpr std::size_t max_lines = 40;
  for (const char* name :
       {"file", "bytes", "spin", "budget_px", "pixel_arcmin", "derivatives", "disk", "code_version"}) {
    print_out("{:<16}{}\n", name, summary[name].is_string() ? summary[name].get<std::string>() : summary[name].dump());
  }
  const auto& stations = summary["stations"];
  const bool disk = summary["disk"].get<bool>();
  print_out("{:<16}{}\n\n{:>10} {:>12} {:>12} {:>8} {:>10} {:>14}{}\n", "stations", stations.size(), "t [s]", "r [M]",
            "theta [deg]", "nodes", "bytes", "gap error [px]", disk ? "   disk bytes disk gap [px]" : "");
  for (std::size_t i = 0; i < stations.size(); i += std::max<std::size_t>(1, stations.size() / max_lines)) {
    const auto& s = stations[i];
    const bool last = s["gap_error_px"].get<double>() < 0.0;
    const auto error = [&](const char* name) {
      return last ? std::string() : fmt::format("{:.3f}", s[name].get<double>());
    };
    // If blending the disk between two stations exceeds the budget, the disk's grid is built live
    // instead.
    const bool live = s["disk_gap_error_px"].get<double>() > summary["budget_px"].get<double>();
    print_out(
        "{:>10.3f} {:>12.6g} {:>12.4f} {:>8} {:>10} {:>14}{}\n", s["t_s"].get<double>(), s["r"].get<double>(),
        s["theta_deg"].get<double>(), s["nodes"].get<int>(), s["bytes"].get<long>(), error("gap_error_px"),
        disk ? fmt::format(" {:>12} {:>13}", s["disk_bytes"].get<long>(), live ? "live" : error("disk_gap_error_px"))
             : "");
  }
  for (const auto& problem : summary["damaged"]) {
    print_out("{}\n", problem.get<std::string>());
  }
}

LensStation station_of_trajectory(const std::filesystem::path& file, double time_s) {
  const TrajectoryReader trajectory(file);
  const auto& all = trajectory.stations();
  // A single station belongs to a static camera and is valid at all times.
  if (all.size() > 1 && !(time_s >= all.front().time_s && time_s <= all.back().time_s)) {
    throw UsageError("inspect --time", fmt::format("{:.9g} s is outside {}", time_s, file.string()),
                     fmt::format("choose from {:.9g} to {:.9g} s", all.front().time_s, all.back().time_s));
  }
  const auto later = std::upper_bound(all.begin(), all.end(), time_s,
                                      [](double t, const StationEntry& station) { return t < station.time_s; });
  return trajectory.read(static_cast<std::size_t>(std::max<std::ptrdiff_t>(later - all.begin() - 1, 0)));
}

}  // namespace ergodome
