#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iterator>
#include <memory>
#include <string>

#include "app/cli/commands.h"
#include "app/cli/output_file.h"
#include "app/commands/rays/ray_groups.h"
#include "content/tables/number_text.h"
#include "content/tables/ray_table.h"
#include "kernels/core/angles.h"
#include "kernels/spacetime/shadow/critical_curve.h"

namespace ergodome {

namespace {

struct EdgeOptions {
  std::string rays;
  std::string out;
  int points = 0;
};

void append_points(const CameraStation& camera, const ShadowChart& chart, const std::string& id, int count,
                   LargeText& text) {
  for (int i = 0; i < count; ++i) {
    const double gamma = full_turn * i / count;
    const double alpha = edge_polar_angle(camera, chart, gamma);
    const Vector3<double> n = chart_direction<double>(chart, std::cos(alpha), std::sin(alpha), gamma);
    fmt::format_to(std::back_inserter(text), "{},{},", id, i);
    append_number(text, n.x);
    text += ',';
    append_number(text, n.y);
    text += ',';
    append_number(text, n.z);
    text += '\n';
  }
}

void run_edge(const EdgeOptions& options) {
  RayTable table = read_ray_table(options.rays);
  if (options.points > 0) {
    // Points of the edge depend only on the camera. Rows are grouped by camera, so that each
    // camera's points are written once.
    group_by_camera(table);
  }
  LargeText text = options.points > 0 ? "id,point,n_r,n_theta,n_phi\n" : "id,edge_distance\n";
  const RayRows& rows = table.rows;
  for_each_camera(rows, [&](std::size_t begin, std::size_t end) {
    const CameraStation camera = station_of(table.camera_of(rows[begin]));
    const ShadowChart chart = make_shadow_chart(camera);
    if (options.points > 0) {
      append_points(camera, chart, table.id_of(rows[begin]), options.points, text);
      return;
    }
    for (std::size_t i = begin; i < end; ++i) {
      text += table.id_of(rows[i]);
      text += ',';
      append_number(text, edge_distance(camera, chart, rows[i].direction));
      text += '\n';
    }
  });
  write_table(options.out, text);
}

}  // namespace

void add_edge_command(CLI::App& app) {
  auto options = std::make_shared<EdgeOptions>();
  CLI::App* command =
      app.add_subcommand("edge", "Compute the angle of directions from the shadow's edge, or points of that edge");
  command->add_option("--rays", options->rays, "table of rays (CSV); see the columns below")
      ->required()
      ->type_name("FILE");
  command->add_option("--out", options->out, "table to write")->required()->type_name("FILE");
  command
      ->add_option("--points", options->points, "instead, write this many points of the shadow's edge for each camera")
      ->check(CLI::Range(1, 1'000'000));
  command->footer(ray_table_help() +
                  "\nedge_distance: angle from the shadow's edge [rad], positive outside. Points are directions, like "
                  "n_r, n_theta, n_phi.");
  command->callback([options] {
    require_table_ending("--out", options->out);
    require_output_file("--out", options->out, {options->rays});
    run_edge(*options);
  });
}

}  // namespace ergodome
