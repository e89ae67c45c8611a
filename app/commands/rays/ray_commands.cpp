#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/option_checks.h"
#include "app/cli/output_file.h"
#include "app/commands/rays/near_ray_commands.h"
#include "app/commands/rays/ray_groups.h"
#include "content/files/console.h"
#include "content/files/printable.h"
#include "content/tables/number_text.h"
#include "content/tables/ray_table.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/launch/launch.h"
#include "render/lens/grid/grid_builder.h"
#include "render/published/quadtree_builder.h"

namespace ergodome {

namespace {

struct RayOptions {
  std::string rays;
  std::string out;
  std::string method = "taylor";
  std::string precision = "double";
  double tolerance = 0.0;
  std::string budget = "0.1px";
  int size_px = 4096;
  int level = 10;
  std::string interpolation = "spline";
  double blend = 0.0;
};

const std::map<std::string, TraceMethod> methods = {{"taylor", TraceMethod::taylor},
                                                    {"rk34", TraceMethod::rk34},
                                                    {"cash_karp", TraceMethod::cash_karp},
                                                    {"closed_form", TraceMethod::closed_form},
                                                    {"baseline_rk34", TraceMethod::baseline_rk34}};

//! Inputs and outputs of a batch of rays that share a camera.
template <class S>
struct BatchArrays {
  std::vector<S> n[3], sky[3], g, status, steps, error_estimate;

  explicit BatchArrays(std::size_t count) {
    for (int i = 0; i < 3; ++i) {
      n[i].resize(count);
      sky[i].resize(count);
    }
    for (auto* each : {&g, &status, &steps, &error_estimate}) {
      each->resize(count);
    }
  }
};

//! Fills the arrays with rows [begin, end), which share a camera, and returns a batch that refers
//! to them.
template <class S>
RayBatch<S> batch_of(const RayTable& rays, std::size_t begin, BatchArrays<S>& arrays) {
  RayBatch<S> batch{};
  batch.camera = converted_station<S>(station_of(rays.camera_of(rays.rows[begin])));
  batch.count = static_cast<int>(arrays.g.size());
  for (int k = 0; k < 3; ++k) {
    batch.direction[k] = arrays.n[k].data();
    batch.sky[k] = arrays.sky[k].data();
  }
  for (std::size_t i = 0; i < arrays.g.size(); ++i) {
    const Vector3<double>& n = rays.rows[begin + i].direction;
    arrays.n[0][i] = static_cast<S>(n.x);
    arrays.n[1][i] = static_cast<S>(n.y);
    arrays.n[2][i] = static_cast<S>(n.z);
  }
  batch.frequency_ratio = arrays.g.data();
  batch.status = arrays.status.data();
  batch.steps = arrays.steps.data();
  batch.error_estimate = arrays.error_estimate.data();
  return batch;
}

//! Output of `trace`: one line per ray.
struct SkyTable : TableText {
  TablePartWriter write;       //!< takes finished lines; empty if the lines must be reordered first
  std::size_t unresolved = 0;  //!< rays that did not converge

  //! Passes on the lines so far.
  void flush() {
    if (write) {
      write(text);
      text.clear();
      begins.clear();
    }
  }
};

//! Writes numbers, each followed by a character, and returns the end of the text.
template <class S, std::size_t count>
char* write_numbers(char* to, const S (&numbers)[count], char after) {
  for (const S number : numbers) {
    to = write_number(to, number);
    *to++ = after;
  }
  return to;
}

//! Appends a line for each ray of a batch that starts at row `begin`. The error estimate is empty
//! for rays that did not converge.
template <class S>
void append_rays(const RayTable& rays, std::size_t begin, const BatchArrays<S>& arrays, SkyTable& table) {
  constexpr std::string_view words[] = {",escaped,", ",captured,", ",not_converged,"};
  for (std::size_t i = 0; i < arrays.g.size(); ++i) {
    const auto status = static_cast<std::size_t>(arrays.status[i]);
    const bool unresolved = status == static_cast<std::size_t>(LightEnd::unresolved);
    char line[8 * room_for_number];
    char* end = std::ranges::copy(words[status], line).out;
    if (status == 0) {
      end = write_numbers(end, {arrays.sky[0][i], arrays.sky[1][i], arrays.sky[2][i]}, ',');
    } else {
      end = std::fill_n(end, 3, ',');
    }
    end = write_numbers(end, {arrays.g[i]}, ',');
    const fmt::format_int steps(static_cast<long>(arrays.steps[i]));
    end = std::copy_n(steps.data(), steps.size(), end);
    *end++ = ',';
    if (!unresolved) {
      end = write_number(end, arrays.error_estimate[i]);
    }
    *end++ = '\n';
    table.begins.push_back(table.text.size());
    table.text += rays.id_of(rays.rows[begin + i]);
    table.text.append(line, static_cast<std::size_t>(end - line));
    table.unresolved += unresolved ? 1 : 0;
  }
  table.flush();
}

//! Calls work(begin, end) for blocks of rows [begin, end). The arrays of a block stay in the cache.
template <class Work>
void for_each_block(std::size_t begin, std::size_t end, const Work& work) {
  constexpr std::size_t rows_at_once = 16'384;
  for (; begin < end; begin += rows_at_once) {
    work(begin, std::min(begin + rows_at_once, end));
  }
}

//! Returns the default tolerance of a method: the smallest that it reaches in float or double. For
//! `baseline_rk34`, the published tracer's own value (`rk34_step(0.01, ...)`), because smaller ones
//! take far too many steps.
double usual_tolerance(const std::string& method, bool in_float) {
  if (method == "baseline_rk34") {
    return 0.01;
  }
  const double finest = method == "taylor" ? 1e-14 : 1e-12;
  return in_float ? 1e-7 : finest;
}

//! Traces rows [begin, end), which share a camera, and appends a line for each.
template <class S>
void trace_group(const RayTable& rays, std::size_t begin, std::size_t end, const RayOptions& options, SkyTable& table) {
  const double tolerance =
      options.tolerance > 0.0 ? options.tolerance : usual_tolerance(options.method, sizeof(S) == 4);
  for_each_block(begin, end, [&](std::size_t first, std::size_t last) {
    BatchArrays<S> arrays(last - first);
    RayBatch<S> batch = batch_of(rays, first, arrays);
    batch.settings = {tolerance, 1'000'000};
    if (options.method == "baseline_rk34") {
      batch.settings.step_limit = 20'000;  // 10 times the published tracer's limit
    }
    batch.method = methods.at(options.method);
    launch(Backend::cpu, batch);
    append_rays(rays, first, arrays, table);
  });
}

//! Looks up the rays of rows [begin, end), which share a camera, in a lens grid built for it, and
//! appends a line for each to the table. Prints statistics of the grid.
void look_up_group(const RayTable& rays, std::size_t begin, std::size_t end, const RayOptions& options,
                   SkyTable& table) {
  const RayCamera& camera = rays.camera_of(rays.rows[begin]);
  GridSettings settings;
  settings.pixel = pi / options.size_px;
  settings.budget_px = pixels_of("--budget", options.budget);
  settings.observer = aberration_to_rain(camera.spacetime, camera.r, camera.theta, camera.motion, camera.velocity);
  settings.fine = options.precision == "double";
  GridStatistics statistics;
  const auto start = std::chrono::steady_clock::now();
  const LensStation station = build_lens_station(camera.spacetime, camera.r, camera.theta, settings, &statistics);
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  const LensGrid grid = grid_view(station);
  for_each_block(begin, end, [&](std::size_t first, std::size_t last) {
    BatchArrays<double> arrays(last - first);
    LookUpRaysBatch<double> batch{
        batch_of(rays, first, arrays), {grid.chart, {grid, grid}, {}, 0.0F}, settings.observer};
    batch.rays.settings = {options.tolerance > 0.0 ? options.tolerance : 1e-9, 10'000};
    launch(Backend::cpu, batch);
    append_rays(rays, first, arrays, table);
  });
  print_out(
      "a {:.9g} r {:.9g} theta {:.9g}: {}{}, {} traced, {}, {} of them ({:.0f} px) left to direct rays, "
      "{:.1f} ms\n",
      camera.spacetime.spin, camera.r, camera.theta, counted(statistics.nodes, "node"),
      station.mirrored ? " (half the sky, mirrored)" : "",
      counted(statistics.traced_nodes + statistics.traced_checks, "ray"), counted(statistics.leaves, "cell"),
      statistics.flagged_leaves, statistics.flagged_px, time.count());
}

//! Looks up the rays of rows [begin, end), which share a camera, in the quadtree grid of Verbraeck
//! & Eisemann (2021), and appends a line for each to the table. Prints statistics of the grid.
void read_quadtree_group(const RayTable& rays, std::size_t begin, std::size_t end, const RayOptions& options,
                         SkyTable& table) {
  const RayCamera& camera = rays.camera_of(rays.rows[begin]);
  QuadtreeSettings settings;
  settings.coarsest_level = std::min(settings.coarsest_level, options.level);
  settings.finest_level = options.level;
  const bool mirrored = quadtree_is_mirrored(camera.theta, camera.velocity);
  // One grid at the camera, or with --blend one half the distance nearer and one half the distance
  // farther.
  std::vector<CameraStation> cameras;
  for (const double side : {-0.5, 0.5}) {
    if (cameras.empty() || options.blend > 0.0) {
      RayCamera at = camera;
      at.r += options.blend > 0.0 ? side * options.blend : 0.0;
      cameras.push_back(station_of(at));
    }
  }
  const auto start = std::chrono::steady_clock::now();
  std::vector<QuadtreeLens> lenses;
  std::vector<QuadtreeShadowTable> shadows;
  for (const CameraStation& station : cameras) {
    lenses.emplace_back(station, mirrored, settings);
    shadows.emplace_back(station, lenses.back().view().level);
  }
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  const bool linear = options.interpolation == "linear";
  const QuadtreeLookUp look_up = {{lenses.front().view(), lenses.back().view()},
                                  {shadows.front().view(), shadows.back().view()},
                                  cameras.size() > 1 ? 0.5F : 0.0F,
                                  linear ? QuadtreeInterpolation::linear : QuadtreeInterpolation::spline};
  for_each_block(begin, end, [&](std::size_t first, std::size_t last) {
    BatchArrays<double> arrays(last - first);
    launch(Backend::cpu, QuadtreeRaysBatch{batch_of(rays, first, arrays), look_up});
    append_rays(rays, first, arrays, table);
  });
  print_out("a {:.9g} r {:.9g} theta {:.9g}: {} rays traced{}, {:.1f} ms\n", camera.spacetime.spin, camera.r,
            camera.theta, lenses.front().vertex_count() + (lenses.size() > 1 ? lenses.back().vertex_count() : 0),
            mirrored ? " (half the sky, mirrored)" : "", time.count());
}

void run_trace(const RayOptions& options) {
  // Groups the rows so that a grid is built only once for each camera.
  RayTable rays = read_ray_table(options.rays);
  const bool ordered = group_by_camera(rays);
  std::size_t unresolved = 0;
  write_table_in_parts(options.out, [&](const TablePartWriter& write) {
    SkyTable table;
    table.text = "id,status,sky_x,sky_y,sky_z,g,steps,error_estimate\n";
    if (ordered) {
      table.write = write;
    }
    for_each_camera(rays.rows, [&](std::size_t begin, std::size_t end) {
      if (options.method == "grid") {
        look_up_group(rays, begin, end, options, table);
      } else if (options.method == "quadtree") {
        read_quadtree_group(rays, begin, end, options, table);
      } else if (options.precision == "float") {
        trace_group<float>(rays, begin, end, options, table);
      } else {
        trace_group<double>(rays, begin, end, options, table);
      }
    });
    unresolved = table.unresolved;
    write(text_in_order(std::move(table), rays.rows));
  });
  if (unresolved > 0) {
    print_note("{} of {} did not converge; choose {}another --method", unresolved, counted(rays.rows.size(), "ray"),
               options.method == "closed_form" ? "" : "a coarser --tolerance, or ");
  }
}

}  // namespace

void add_trace_command(CLI::App& app) {
  auto options = std::make_shared<RayOptions>();
  CLI::App* command =
      app.add_subcommand("trace", "Trace single light rays listed in a table, and write a table of results");
  command->add_option("--rays", options->rays, "table of rays (CSV); see the columns below")
      ->required()
      ->type_name("FILE");
  command->add_option("--out", options->out, "table to write")->required()->type_name("FILE");
  CLI::Option* const method =
      command
          ->add_option(
              "--method", options->method,
              "integrator (taylor, rk34, cash_karp, closed_form, baseline_rk34), or a lens grid built for each camera "
              "(grid, quadtree)")
          ->check(CLI::IsMember({"taylor", "rk34", "cash_karp", "closed_form", "baseline_rk34", "grid", "quadtree"}))
          ->capture_default_str();
  CLI::Option* const precision = command->add_option("--precision", options->precision, "arithmetic: float or double")
                                     ->check(CLI::IsMember({"float", "double"}))
                                     ->capture_default_str();
  command
      ->add_option("--tolerance", options->tolerance,
                   "accepted error of the sky direction [rad] (default: the smallest possible; for baseline_rk34 0.01)")
      ->check(number_between(1e-16, 1.0));
  command->option_defaults()->group("Lens grids");
  command->add_option("--budget", options->budget, "with --method grid: accepted displacement on the screen")
      ->capture_default_str();
  command
      ->add_option("--size", options->size_px,
                   "with --method grid: width in pixels of the screen, a dome of 180 degrees")
      ->check(CLI::Range(16, 1'000'000))
      ->capture_default_str();
  command->add_option("--level", options->level, "with --method quadtree: finest level")
      ->check(CLI::Range(3, 13))
      ->capture_default_str();
  command->add_option("--interpolation", options->interpolation, "with --method quadtree: linear or spline")
      ->check(CLI::IsMember({"linear", "spline"}))
      ->capture_default_str();
  command
      ->add_option("--blend", options->blend,
                   "with --method quadtree: blend two grids whose radii differ by this much [M]")
      ->check(number_between(0.0, 1e3));
  command->option_defaults()->group("Disk, shells and objects");
  const auto near_field = add_near_ray_options(*command, {method, precision});
  IgnoredOptions ignored(*command);
  ignored.add("without --method grid", [options] { return options->method != "grid"; }, {"--budget", "--size"});
  ignored.add("without --method quadtree", [options] { return options->method != "quadtree"; },
              {"--level", "--interpolation", "--blend"});
  ignored.add("with --method closed_form", [options] { return options->method == "closed_form"; },
              {"--tolerance", "--precision"});
  ignored.add("with --method quadtree", [options] { return options->method == "quadtree"; },
              {"--tolerance", "--precision"});
  command->footer(
      ray_table_help() +
      "\nsky_x, sky_y, sky_z: unit vector to the origin of the light in the distant sky: z along the spin axis, "
      "x toward\nphi = 0, y toward phi = 90 degrees. g: observed frequency over the frequency emitted there.");
  command->callback([options, near_field, ignored] {
    ignored.refuse();
    require_table_ending("--out", options->out);
    require_output_file("--out", options->out, {options->rays, near_field->objects});
    if (!run_near_rays(*near_field, {options->rays, options->out, options->tolerance})) {
      run_trace(*options);
    }
  });
}

}  // namespace ergodome
