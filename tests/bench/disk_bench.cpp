#include <benchmark/benchmark.h>

#include <memory>
#include <optional>

#include "content/show/reading/show_reader.h"
#include "kernels/launch/parallel_for.h"
#include "kernels/projection/pixel_measure.h"
#include "render/eyes/view_projection.h"
#include "render/passes/disk/disk_grids.h"
#include "render/passes/disk/disk_layers.h"
#include "render/passes/near_field/near_field.h"

// Times of drawing a disk without a sky into memory. The disk's light comes from a ray for each
// pixel that may see the disk (rays), from an existing grid (kept_grid), from a grid that is built
// for each picture (live_grid), or from baked layers that are blended for each picture (streamed).
namespace {

using namespace ergodome;

enum class DiskLens { rays, kept_grid, live_grid, streamed };

//! What the scene contains in addition to the plain disk.
enum class Beside { nothing, clouds, ball };

//! Returns a show with the same disk and view as the built-in show of a disk.
Show disk_show(Beside beside) {
  return parse_show(std::string("[hole]\nspin = 0.999\n[camera]\nobserver = \"zamo\"\n[[camera.key]]\nr = 60\n"
                                "theta_deg = 83\n[sky]\nmap = \"milky_way\"\n[effects]\nredshift = true\n"
                                "[disk]\nouter = 18\ntemperature_K = 20000\nlimb_darkening = true\n") +
                        (beside == Beside::clouds ? "pattern = \"procedural\"\n" : "") +
                        (beside == Beside::ball ? "[[objects]]\nmethod = \"trace\"\nshape = \"sphere\"\nsegments = 96\n"
                                                  "rings = 48\nsize = 2.2\nposition = [22, -8, 1]\n"
                                                : "") +
                        "[view]\nprojection = \"pinhole\"\nfov_deg = 40\naspect = 1.7777778\n",
                    "bench.toml");
}

//! Returns the blend of the baked disk layers at two camera positions, r = 60 and 57 M. Their
//! distance is typical for the trajectory file of the built-in show.
std::shared_ptr<const JoinedDisk> baked_pair(const Show& show, const DiskAppearance& disk, double pixel) {
  const auto station = [&](double r) {
    CameraPose pose = camera_pose(show, 0.0);
    pose.r = r;
    const EyeCamera eye = eye_camera(show, pose, 0.0);
    DiskGridSettings settings = disk_grid_settings(eye, disk, pixel);
    settings.budget_px = 0.125;
    settings.derivatives = true;
    return build_disk_station(eye.spacetime, eye.r, eye.theta, settings);
  };
  return std::make_shared<const JoinedDisk>(join(station(60.0), station(57.0)).value());
}

void disk_picture(benchmark::State& state, DiskLens lens, Beside beside) {
  const Show show = disk_show(beside);
  const DiskPass pass(show, Backend::cpu);
  const std::unique_ptr<TracedObjects> objects = traced_objects_of(show, Backend::cpu);
  const Projection projection = make_projection(show.view, static_cast<int>(state.range(0)), 0.0);
  CameraPose pose = camera_pose(show, 0.0);
  const double pixels = static_cast<double>(projection.width_px) * projection.height_px;
  std::vector<float> rgba(4 * static_cast<std::size_t>(pixels));
  DiskGrids grids;
  const bool streamed = lens == DiskLens::streamed;
  const auto baked = streamed ? baked_pair(show, pass.look_at(0.0), pixel_angle(projection)) : nullptr;
  std::optional<DiskLayers> layers;
  pose.r -= streamed ? 1.5 : 0.0;
  for (auto _ : state) {
    pose.r += lens == DiskLens::live_grid || streamed ? 1e-9 : 0.0;
    const EyeCamera eye = eye_camera(show, pose, 0.0);
    NearField near_field{&pass, nullptr, objects.get(), {}};
    if (streamed) {
      layers.emplace(baked, LensPosition{eye.r, eye.theta});
      near_field.disk_grid = layers->view();
    } else if (lens != DiskLens::rays) {
      near_field.disk_grid = grids.grid_for({eye, pass.look_at(0.0), pixel_angle(projection), 0.25, pixels, true});
    }
    draw_near_field(Backend::cpu, near_field, {eye, nullptr, projection, 0.05, 0.0}, {0, projection.height_px},
                    rgba.data());
    benchmark::DoNotOptimize(rgba.data());
  }
  state.counters["ns_per_pixel"] =
      benchmark::Counter(pixels * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetLabel(std::string(name_of(active_instruction_set())) + ", " + std::to_string(thread_count()) + " threads");
}

void disk_widths(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(480)->Arg(960)->Arg(1920)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(disk_picture, rays, DiskLens::rays, Beside::nothing)->Apply(disk_widths);
BENCHMARK_CAPTURE(disk_picture, kept_grid, DiskLens::kept_grid, Beside::nothing)->Apply(disk_widths);
BENCHMARK_CAPTURE(disk_picture, live_grid, DiskLens::live_grid, Beside::nothing)->Apply(disk_widths);
BENCHMARK_CAPTURE(disk_picture, streamed, DiskLens::streamed, Beside::nothing)->Apply(disk_widths);
BENCHMARK_CAPTURE(disk_picture, rays_clouds, DiskLens::rays, Beside::clouds)->Apply(disk_widths);
BENCHMARK_CAPTURE(disk_picture, kept_grid_clouds, DiskLens::kept_grid, Beside::clouds)->Apply(disk_widths);
BENCHMARK_CAPTURE(disk_picture, live_grid_clouds, DiskLens::live_grid, Beside::clouds)->Apply(disk_widths);
BENCHMARK_CAPTURE(disk_picture, streamed_clouds, DiskLens::streamed, Beside::clouds)->Apply(disk_widths);
BENCHMARK_CAPTURE(disk_picture, rays_ball, DiskLens::rays, Beside::ball)->Apply(disk_widths);
BENCHMARK_CAPTURE(disk_picture, kept_grid_ball, DiskLens::kept_grid, Beside::ball)->Apply(disk_widths);
BENCHMARK_CAPTURE(disk_picture, live_grid_ball, DiskLens::live_grid, Beside::ball)->Apply(disk_widths);

}  // namespace
