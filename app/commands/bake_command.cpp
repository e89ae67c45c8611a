#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <random>
#include <tuple>
#include <utility>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/option_checks.h"
#include "app/cli/output_file.h"
#include "app/cli/progress.h"
#include "app/cli/show_loading.h"
#include "app/cli/show_options.h"
#include "app/commands/bake_settings.h"
#include "app/commands/inspect/inspect_trajectory.h"
#include "content/files/atomic_file.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "content/trajectory/trajectory_journal.h"
#include "content/trajectory/trajectory_reader.h"
#include "kernels/core/error.h"
#include "render/bake/trajectory_baker.h"
#include "render/frame/require_path.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

struct BakeOptions {
  std::string show;
  ShowSettings set;
  std::string out;
  std::string part;
  int size_px = 0;
  double budget_px = 0.0;
  bool no_derivatives = false;
  bool replace = false;
};

//! Parses "K/N" into K and N. Returns nothing for other text, and unless 1 <= K <= N <= 1000.
std::optional<std::pair<int, int>> part_of(const std::string& text) {
  int part = 0;
  int parts = 0;
  int used = 0;
  const bool read = std::sscanf(text.c_str(), "%d/%d%n", &part, &parts, &used) == 2;
  if (!read || used != static_cast<int>(text.size()) || part < 1 || part > parts || parts > 1000) {
    return std::nullopt;
  }
  return std::pair(part, parts);
}

BakeSettings settings_of(const BakeOptions& options, const Show& show) {
  BakeSettings settings = bake_settings(show, options.size_px, options.budget_px);
  settings.derivatives = !options.no_derivatives;
  if (!options.part.empty()) {
    std::tie(settings.part, settings.parts) = part_of(options.part).value();
  }
  return settings;
}

//! Opens the journal of a part. If another process bakes the same part, or a machine that is believed
//! to have failed holds the lock, opens a new journal beside it: both contain the same stations, and
//! joining the parts takes each once.
TrajectoryJournal open_part(const fs::path& path, const TrajectoryProvenance& provenance) {
  std::optional<TrajectoryJournal> journal = TrajectoryJournal::try_open(path, provenance);
  if (journal) {
    return std::move(*journal);
  }
  const fs::path own = fmt::format("{}-{:08x}", path.string(), std::random_device()());
  print_note("{} is in use by another process; this part is baked to {}", path.string(), own.string());
  return {own, provenance};
}

fs::path journal_path(const BakeOptions& options, const BakeSettings& settings) {
  return settings.parts == 1 ? fs::path(options.out + ".part")
                             : fs::path(fmt::format("{}.part-{}-of-{}", options.out, settings.part, settings.parts));
}

//! Returns the sorted files in the folder of the output whose names have this beginning and end.
std::vector<fs::path> beside(const fs::path& out, const std::string& beginning, const std::string& end) {
  std::vector<fs::path> found;
  std::error_code problem;
  const fs::path folder = out.has_parent_path() ? out.parent_path() : fs::path(".");
  for (const auto& entry : fs::directory_iterator(folder, problem)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(beginning) && name.ends_with(end)) {
      found.push_back(entry.path());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

bool is_baked(const fs::path& out, const TrajectoryProvenance& provenance) {
  std::error_code problem;
  if (!fs::exists(out, problem)) {
    return false;
  }
  try {
    return TrajectoryReader(out).provenance() == provenance;
  } catch (const Error&) {
    return false;
  }
}

//! Throws Error if the output exists and is not a trajectory of this show: another file may have
//! taken hours to make. The settings with which it was baked do not matter.
void require_own(const fs::path& out, const Show& show) {
  std::error_code problem;
  if (!fs::exists(out, problem)) {
    return;
  }
  const auto refuse = [&](const std::string& why) {
    throw Error("--out " + out.string(), why, "choose another name, or add --replace to overwrite it");
  };
  if (!is_trajectory(out)) {
    refuse("already exists and is not a trajectory");
  }
  try {
    require_path_of(show, TrajectoryReader(out));
  } catch (const Error& error) {
    // A trajectory that is damaged or of another version cannot be used here, but another version
    // of the program may need it.
    refuse("already exists and does not belong to this show: " + error.problem());
  }
}

//! Adds the stations of all parts to a journal. Skips parts that another process is still writing,
//! because the bake computes stations that are missing.
void absorb_parts(const std::vector<fs::path>& parts, const TrajectoryProvenance& provenance,
                  TrajectoryJournal& journal) {
  for (const fs::path& part : parts) {
    if (const std::optional<TrajectoryJournal> finished = TrajectoryJournal::try_open(part, provenance)) {
      journal.absorb(*finished);
    } else {
      print_note("{} is still in use by another process; its missing stations are baked again", part.string());
    }
  }
}

BakeResult bake(const Show& show, const BakeSettings& settings, TrajectoryJournal& journal) {
  constexpr long steps = 10'000;
  Progress progress("baking", steps);
  return bake_trajectory(show, settings, journal, [&](double done_s) {
    const double whole_s = std::max(show.duration_s, 1e-9);
    const double begin_s = whole_s * (settings.part - 1) / settings.parts;
    progress.advance_to(std::clamp(std::lround(steps * settings.parts * (done_s - begin_s) / whole_s), 0L, steps));
    return !interrupted();
  });
}

//! Returns the largest error from blending the disk, as text: " in the sky, 0.196 px in the disk".
//! Leaves out gaps where it exceeds the budget, because the disk is computed live there. Empty if
//! the disk is never blended.
std::string disk_text(const TrajectoryReader& trajectory) {
  double worst_px = 0.0;
  for (const StationEntry& station : trajectory.stations()) {
    const double error_px = static_cast<double>(station.disk_gap_error_px);
    if (station.disk_bytes > 0 && error_px <= trajectory.provenance().budget_px) {
      worst_px = std::max(worst_px, error_px);
    }
  }
  return worst_px > 0.0 ? fmt::format(" in the sky, {:.3f} px in the disk", worst_px) : "";
}

void say(const fs::path& file, const BakeResult& result, double seconds) {
  const TrajectoryReader trajectory(file);
  const std::string disk = disk_text(trajectory);
  print_out("{}: {} ({} computed now), {:.1f} MB, {:.1f} s; largest blending error {:.3f} px{}\n", file.string(),
            counted(trajectory.stations().size(), "station"), result.built,
            1e-6 * static_cast<double>(trajectory.file_bytes()), seconds, result.worst_px, disk);
  if (result.live_disk_s > 0.0) {
    print_out(
        "the disk is recomputed live during {:.1f} s of the show near its plane, where blending would exceed the "
        "budget\n",
        result.live_disk_s);
  }
  if (result.unmet > 0) {
    const double budget_px = trajectory.provenance().budget_px;
    print_note(
        "{} of {} between stations {} the budget of {} px; the largest error is {:.3f} px at {:.2f} s; "
        "frames there use live grids ({:.3g} s of the show)",
        result.unmet, counted(static_cast<long>(trajectory.stations().size()) - 1, "gap"),
        result.unmet == 1 ? "exceeds" : "exceed", budget_px, result.worst_px, result.worst_time_s,
        missed_gaps(trajectory.stations(), budget_px).seconds);
  }
}

void run(const BakeOptions& options) {
  require_output_file("--out", options.out, {options.show});
  const auto start = std::chrono::steady_clock::now();
  const Show show = load_show(options.show, options.set);
  if (show.grid_scheme != GridScheme::conforming) {
    throw Error(show.name, "grid.scheme = \"quadtree\" is only for comparisons and cannot be baked",
                "remove grid.scheme from the show");
  }
  const BakeSettings settings = settings_of(options, show);
  const TrajectoryProvenance provenance = provenance_of(show, settings);
  const fs::path out = options.out;
  if (!options.replace) {
    require_own(out, show);
  }
  const std::string name = out.filename().string();
  const bool whole = settings.parts == 1;
  const fs::path path = journal_path(options, settings);
  std::vector<fs::path> journals = {path};
  const std::vector<fs::path> parts = whole ? beside(out, name + ".part-", "") : std::vector<fs::path>{};
  if (parts.empty() && !fs::exists(path) && is_baked(out, provenance)) {
    print_out("{}: is already baked\n", out.string());
    return;
  }
  TrajectoryJournal journal = whole ? TrajectoryJournal(path, provenance) : open_part(path, provenance);
  absorb_parts(parts, provenance, journal);
  journals.insert(journals.end(), parts.begin(), parts.end());
  const BakeResult result = bake(show, settings, journal);
  if (!whole) {
    print_out("{}: part {} of {} is baked ({}); run bake without --part to join the parts\n", path.string(),
              settings.part, settings.parts, counted(journal.station_count(), "station"));
    return;
  }
  // Removes the partial file that an earlier bake left if it was killed in seal().
  remove_abandoned_files(fs::absolute(behind_links(out)).parent_path());
  journal.seal(out, result.times_s);
  for (const fs::path& done : journals) {
    fs::remove(done);
  }
  say(out, result, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

}  // namespace

void add_bake_command(CLI::App& app) {
  auto options = std::make_shared<BakeOptions>();
  CLI::App* command = app.add_subcommand(
      "bake", "Compute the lenses along a show's camera path in advance; continues an interrupted run");
  command->add_option("show", options->show, "show file (.toml) or name of a built-in show")->required();
  add_set_option(*command, options->set);
  command->add_option("--out", options->out, "trajectory file to write")->required()->type_name("FILE");
  command->add_option("--part", options->part, "bake only part K of N; run the other parts in other processes")
      ->type_name("K/N")
      ->check([](const std::string& text) {
        return part_of(text) ? std::string() : "\"" + text + "\" does not name a part; write K/N, for instance 2/4";
      });
  command
      ->add_option("--size", options->size_px,
                   "image width in pixels for which the error budget holds (default: the show's)")
      ->check(CLI::Range(1, 16384));
  command->add_option("--budget", options->budget_px, "accepted error in pixels (default: the show's)")
      ->check(number_between(1e-3, 100.0));
  command->add_flag("--no-derivatives", options->no_derivatives,
                    "store no derivatives: needs many more stations, and stereo eyes use live grids");
  command->add_flag("--replace", options->replace, "overwrite --out even if it is not a trajectory of this show");
  command->callback([options] { run(*options); });
}

}  // namespace ergodome
