#include "app/lens_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "content/files/counted.h"
#include "kernels/core/error.h"
#include "kernels/projection/pixel_measure.h"
#include "render/frame/show_renderer.h"
#include "render/lens/lens_chooser.h"

namespace ergodome {

namespace {

void say(const std::string& message) { fmt::print(stderr, "ergodome: {}\n", message); }

//! Angle of a pixel [rad] in pictures of a width; 0: the show's own.
double pixel_of(const Show& show, int size_px) {
  return pixel_angle(make_projection(show.view, size_px > 0 ? size_px : show.view.size_px, 0.0));
}

std::shared_ptr<StationStream> open(const Show& show, const std::filesystem::path& file, const LensOptions& options,
                                    Backend backend) {
  TrajectoryReader trajectory(file);
  require_path_of(show, trajectory);
  const std::size_t memory = static_cast<std::size_t>(options.stream_memory_mib) << 20U;
  return std::make_shared<StationStream>(backend, std::move(trajectory), memory,
                                         [](const std::string& problem) { say(problem + " (skipped)"); });
}

}  // namespace

void add_lens_options(CLI::App& command, LensOptions& options) {
  command
      .add_option("--lens", options.lens,
                  "streamed (from a trajectory), live (a grid for each place), direct (a ray a pixel), or auto")
      ->check(CLI::IsMember({"auto", "streamed", "live", "direct"}))
      ->capture_default_str();
  command.add_option("--trajectory", options.trajectory,
                     "file made by ergodome bake (default: the show's name with .trajectory, beside it)");
  command.add_option("--stream-memory", options.stream_memory_mib, "most memory for streamed stations, in MiB")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
}

LensChoice lens_choice(const LensOptions& options) {
  return options.lens == "streamed" ? LensChoice::streamed
         : options.lens == "live"   ? LensChoice::live
         : options.lens == "direct" ? LensChoice::direct
                                    : LensChoice::automatic;
}

std::shared_ptr<StationStream> open_stream(const Show& show, const LensOptions& options, Backend backend) {
  const LensChoice choice = lens_choice(options);
  if (choice == LensChoice::live || choice == LensChoice::direct) {
    return nullptr;
  }
  if (!options.trajectory.empty()) {
    return open(show, options.trajectory, options, backend);
  }
  const std::filesystem::path beside = std::filesystem::path(show.folder) / (show.name + ".trajectory");
  std::error_code problem;
  if (!std::filesystem::exists(beside, problem)) {
    if (choice == LensChoice::streamed) {
      throw Error(beside.string(), "there is no trajectory to stream from",
                  "make one with ergodome bake, and name it with --trajectory");
    }
    return nullptr;
  }
  try {
    return open(show, beside, options, backend);
  } catch (const Error& error) {
    if (choice == LensChoice::streamed) {
      throw;
    }
    say(std::string(error.what()) + " (left alone)");
    return nullptr;
  }
}

bool is_fine_enough(const StationStream& stream, const Show& show, int size_px) {
  const TrajectoryProvenance& baked = stream.trajectory().provenance();
  return holds_budget(baked, show.quality.budget_px * pixel_of(show, size_px));
}

void tell_coarse_stream(const StationStream* stream, const Show& show, const LensOptions& options, int size_px) {
  if (stream == nullptr || is_fine_enough(*stream, show, size_px)) {
    return;
  }
  const TrajectoryProvenance& baked = stream->trajectory().provenance();
  const int width_px = size_px > 0 ? size_px : show.view.size_px;
  say(fmt::format(
      "the trajectory was baked for {} px in pictures {:.0f} px wide, and is too coarse for {} px at {}: {}; "
      "bake it again with --size {}",
      baked.budget_px, width_px * pixel_of(show, size_px) / baked.pixel, show.quality.budget_px, width_px,
      lens_choice(options) == LensChoice::streamed ? "the budget is missed" : "lenses are made anew", width_px));
}

void print_statistics(const StreamStatistics& s) {
  fmt::print("streamed: {}, {} of them waited, {} given up; {} read, {} bad{}; {:.1f} MiB held at most\n",
             counted(s.asked, "lens", "lenses"), s.waits, s.missed, counted(s.read, "station"), s.bad,
             s.lost_disks > 0 ? fmt::format(", {} without their disk", s.lost_disks) : "",
             static_cast<double>(s.most_bytes_held) / (1 << 20));
}

}  // namespace ergodome
