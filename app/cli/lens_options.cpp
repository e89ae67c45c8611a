#include "app/cli/lens_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <set>

#include "app/cli/usage_error.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "content/show/stereo_eyes.h"
#include "kernels/core/error.h"
#include "kernels/projection/pixel_measure.h"
#include "render/frame/require_path.h"
#include "render/frame/show_renderer.h"
#include "render/lens/lens_chooser.h"
#include "render/lens/lens_source.h"

namespace ergodome {

namespace {

//! Returns the projection of one eye's picture of this width; 0: the show's.
Projection projection_of(const Show& show, int size_px) {
  return make_projection(show.view, size_px > 0 ? size_px : show.view.size_px, 0.0);
}

std::shared_ptr<StationStream> open(const Show& show, const std::filesystem::path& file, const LensOptions& options,
                                    Backend backend, const NoteSink& report) {
  TrajectoryReader trajectory(file);
  require_path_of(show, trajectory);
  const std::size_t memory = static_cast<std::size_t>(options.stream_memory_mib.value_or(usual_stream_memory_mib))
                             << 20U;
  return std::make_shared<StationStream>(backend, std::move(trajectory), memory,
                                         [report](const std::string& problem) { report(problem + " (skipped)"); });
}

//! Returns the default path of a show's trajectory.
std::filesystem::path trajectory_beside(const Show& show) {
  return std::filesystem::path(show.folder) / (show.name + ".trajectory");
}

//! Describes what happens with pictures of this projection if stations are too coarse.
const char* stand_in_for_stream(const Projection& projection, const LensOptions& options, Backend backend) {
  if (lens_choice(options) == LensChoice::streamed) {
    return "frames exceed the budget";
  }
  const double pixels = static_cast<double>(projection.width_px) * projection.height_px;
  return is_worth_a_grid(backend, pixels) ? "lenses are computed live instead" : "each pixel is traced instead";
}

}  // namespace

void add_lens_options(CLI::App& command, LensOptions& options, IgnoredOptions& ignored) {
  command
      .add_option("--lens", options.lens,
                  "lenses: streamed (from a trajectory), live (grid), direct (ray per pixel), auto")
      ->check(CLI::IsMember({"auto", "streamed", "live", "direct"}))
      ->capture_default_str();
  command
      .add_option("--trajectory", options.trajectory,
                  "file from ergodome bake (default: SHOW.trajectory beside the show)")
      ->type_name("FILE");
  command
      .add_option("--stream-memory", options.stream_memory_mib,
                  fmt::format("memory limit for streamed stations in MiB (default: {})", usual_stream_memory_mib))
      ->check(CLI::Range(1, 1 << 20));
  ignored.add("with --lens live or direct",
              [&options] {
                const LensChoice choice = lens_choice(options);
                return choice == LensChoice::live || choice == LensChoice::direct;
              },
              {"--trajectory", "--stream-memory"});
}

LensChoice lens_choice(const LensOptions& options) {
  return options.lens == "streamed" ? LensChoice::streamed
         : options.lens == "live"   ? LensChoice::live
         : options.lens == "direct" ? LensChoice::direct
                                    : LensChoice::automatic;
}

void print_note_once(const std::string& note) {
  static std::mutex mutex;
  static std::set<std::string> printed;
  const std::scoped_lock lock(mutex);
  if (printed.insert(note).second) {
    print_note("{}", note);
  }
}

std::shared_ptr<StationStream> open_stream(const Show& show, const LensOptions& options, Backend backend,
                                           NoteSink report) {
  const LensChoice choice = lens_choice(options);
  if (choice == LensChoice::live || choice == LensChoice::direct) {
    return nullptr;
  }
  if (!options.trajectory.empty()) {
    return open(show, options.trajectory, options, backend, report);
  }
  const std::filesystem::path beside = trajectory_beside(show);
  std::error_code problem;
  if (!std::filesystem::exists(beside, problem)) {
    if (choice == LensChoice::streamed) {
      throw Error(beside.string(), "is missing, but --lens streamed needs a trajectory",
                  "make one with ergodome bake, or name one with --trajectory");
    }
    return nullptr;
  }
  try {
    return open(show, beside, options, backend, report);
  } catch (const Error& error) {
    if (choice == LensChoice::streamed) {
      throw;
    }
    report(std::string(error.what()) + " (trajectory ignored)");
    return nullptr;
  }
}

void require_used_memory(const Show& show, const LensOptions& options) {
  std::error_code problem;
  if (options.stream_memory_mib && options.trajectory.empty() && lens_choice(options) == LensChoice::automatic &&
      !std::filesystem::exists(trajectory_beside(show), problem)) {
    throw UsageError("--stream-memory", fmt::format("has no effect, because {} has no trajectory", show.name),
                     "leave it out, or name one with --trajectory");
  }
}

bool is_fine_enough(const StationStream& stream, const Show& show, int size_px) {
  const TrajectoryProvenance& baked = stream.trajectory().provenance();
  return holds_budget(baked, show.quality.budget_px * pixel_angle(projection_of(show, size_px)));
}

std::vector<std::string> stream_notes(const StationStream* stream, const Show& show, const LensOptions& options,
                                      Backend backend, int size_px) {
  if (stream == nullptr) {
    return {};
  }
  const TrajectoryReader& trajectory = stream->trajectory();
  if (has_camera_per_direction(show.stereo)) {
    const bool asked_for = !options.trajectory.empty() || lens_choice(options) == LensChoice::streamed;
    return asked_for ? std::vector{fmt::format(
                           "stereo model omni has a camera for each pixel, so the trajectory {} is not used",
                           trajectory.path().string())}
                     : std::vector<std::string>();
  }
  const TrajectoryProvenance& baked = trajectory.provenance();
  const Projection projection = projection_of(show, size_px);
  const int width_px = size_px > 0 ? size_px : show.view.size_px;
  const double pixel = pixel_angle(projection);
  const double budget_px = show.quality.budget_px;
  if (!is_fine_enough(*stream, show, size_px)) {
    // Three digits are enough, because holds_budget() allows 1 %.
    const std::string finer = budget_px < baked.budget_px ? fmt::format(" --budget {:.3g}", budget_px) : "";
    // Names the trajectory, because each text is printed only once, and two shows of an exhibit may
    // both have one that is too coarse.
    return {
        fmt::format("{} was baked for {:.3g} px in frames {:.0f} px wide and is too coarse for {:.3g} px at {}: {}; "
                    "bake it again with --size {}{}",
                    trajectory.path().string(), baked.budget_px, width_px * pixel / baked.pixel, budget_px, width_px,
                    stand_in_for_stream(projection, options, backend), width_px, finer)};
  }
  // Angle of a pixel for which the stations were baked / angle of a pixel of this picture.
  const double scale = baked.pixel / pixel;
  const MissedGaps missed = missed_gaps(trajectory.stations(), std::max(budget_px / scale, baked.budget_px));
  if (missed.count == 0) {
    return {};
  }
  return {fmt::format(
      "{} exceeds the budget of {:.3g} px in {} between its stations ({:.3g} s of the show); the largest error "
      "is {:.3f} px at {:.2f} s; frames there use live grids",
      trajectory.path().string(), budget_px, counted(missed.count, "gap"), missed.seconds, missed.worst_px * scale,
      missed.worst_time_s)};
}

void print_statistics(const StreamStatistics& s) {
  print_out("streamed: {} ({} delayed, {} given up); {} read ({} damaged{}); peak memory {:.1f} MiB\n",
            counted(s.asked, "lens", "lenses"), s.waits, s.missed, counted(s.read, "station"), s.bad,
            s.lost_disks > 0 ? fmt::format(", {} without disk", s.lost_disks) : "",
            static_cast<double>(s.max_bytes_held) / (1 << 20));
}

void add_budget_option(CLI::App& command, std::vector<std::string>& words) {
  command
      .add_option(
          "--budget", words,
          "keep an error (0.25px), a frame rate (60fps) or both (0.25px,60fps); settings are measured and chosen "
          "at the start, in up to two seconds")
      ->allow_extra_args(false);
}

}  // namespace ergodome
