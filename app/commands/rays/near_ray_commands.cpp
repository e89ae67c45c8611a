#include "app/commands/rays/near_ray_commands.h"

#include <CLI/CLI.hpp>
#include <functional>
#include <span>

#include "app/cli/option_checks.h"
#include "app/cli/output_file.h"
#include "app/cli/show_loading.h"
#include "app/cli/show_options.h"
#include "app/cli/usage_error.h"
#include "app/commands/rays/disk_crossing_table.h"
#include "app/commands/rays/object_hit_table.h"
#include "app/commands/rays/ray_groups.h"
#include "app/commands/rays/shell_crossing_table.h"
#include "content/tables/ray_table.h"

namespace ergodome {

namespace {

//! Returns the lines of rows that share a camera.
using LinesOf = std::function<std::string(const RayTable& table, std::span<const RayRow> rows)>;

//! Writes a header line and the lines of each camera's rays.
void write_lines(const RayFiles& files, const char* head, const LinesOf& lines) {
  const RayTable table = read_ray_table(files.rays);
  LargeText text = head;
  for_each_camera(table.rows, [&](std::size_t begin, std::size_t end) {
    text += lines(table, std::span(table.rows).subspan(begin, end - begin));
  });
  write_table(files.out, text);
}

void run_disk(const NearRayOptions& options, const RayFiles& files) {
  CrossingTableOptions crossings;
  crossings.tolerance = files.tolerance > 0.0 ? files.tolerance : crossings.tolerance;
  crossings.plunging = options.plunging;
  write_lines(files, crossing_table_head, [&](const RayTable& table, std::span<const RayRow> rows) {
    return crossing_lines(table, rows, crossings);
  });
}

void run_shell(const NearRayOptions& options, const RayFiles& files) {
  ShellTableOptions shell{*options.shell_r};
  shell.tolerance = files.tolerance > 0.0 ? files.tolerance : shell.tolerance;
  write_lines(files, shell_table_head,
              [&](const RayTable& table, std::span<const RayRow> rows) { return shell_lines(table, rows, shell); });
}

void run_objects(const NearRayOptions& options, const RayFiles& files) {
  const Show show = load_show(options.objects, options.set);
  if (show.objects.empty()) {
    throw UsageError("trace --objects", options.objects + " has no objects", "choose a show with [[objects]]");
  }
  if (show.duration_s > 0.0) {
    require_time("trace --at", show, options.time_s);
  }
  const ObjectRays objects(show, options.time_s);
  const double tolerance = files.tolerance > 0.0 ? files.tolerance : 1e-15;
  write_lines(files, object_table_head, [&](const RayTable& table, std::span<const RayRow> rows) {
    return object_lines(table, rows, objects, tolerance);
  });
}

}  // namespace

std::shared_ptr<NearRayOptions> add_near_ray_options(CLI::App& command, const std::vector<CLI::Option*>& excluded) {
  auto options = std::make_shared<NearRayOptions>();
  CLI::Option* const disk = command.add_flag(
      "--disk", options->disk,
      "list each ray's first three crossings of the equatorial plane: radius, azimuth, delay, g of a circular "
      "orbit");
  command
      .add_flag("--plunging", options->plunging,
                "with --disk: also compute g inside the last stable orbit, for matter that falls in from it")
      ->needs(disk);
  CLI::Option* const shell =
      command
          .add_option("--shell", options->shell_r,
                      "list each ray's crossings of a sphere of this radius [M]: polar angle, azimuth, times, g of a "
                      "zero-angular-momentum observer")
          ->check(number_between(1.0, 1e15))
          ->excludes(disk);
  CLI::Option* const objects =
      command
          .add_option("--objects", options->objects,
                      "list where rays hit the objects of this show: object, triangle, weights of its second and third "
                      "corner, position, delay")
          ->type_name("SHOW")
          ->excludes(disk)
          ->excludes(shell);
  add_set_option(command, options->set)->needs(objects);
  command.add_option("--at", options->time_s, "with --objects: time in the show [s]")
      ->check(show_time())
      ->needs(objects);
  for (CLI::Option* const other : excluded) {
    disk->excludes(other);
    shell->excludes(other);
    objects->excludes(other);
  }
  return options;
}

bool run_near_rays(const NearRayOptions& options, const RayFiles& files) {
  if (options.disk) {
    run_disk(options, files);
  } else if (options.shell_r) {
    run_shell(options, files);
  } else if (!options.objects.empty()) {
    run_objects(options, files);
  } else {
    return false;
  }
  return true;
}

}  // namespace ergodome
