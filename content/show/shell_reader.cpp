#include "content/show/shell_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "content/files/toml_table.h"
#include "content/show/animated_show.h"
#include "content/show/own_number.h"
#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

constexpr double brightest_shell = 1e6;

std::string name_of(std::size_t shell) { return fmt::format("shells[{}]", shell); }

void read_color(TomlTable& table, std::string_view key, std::array<double, 3>& color) {
  if (table.has(key)) {
    std::ranges::copy(table.numbers(key, 3, 3, 0.0, brightest_shell), color.begin());
  }
}

ShellSettings read_shell(TomlTable& table) {
  ShellSettings shell;
  if (!table.has("radius")) {
    throw table.error_at("radius", "is missing", "give the radius of the shell in units of M, for example radius = 10");
  }
  shell.radius = own_number(table, "radius", shell.radius);
  shell.spacing_deg = table.number("spacing_deg", shell.spacing_deg, 0.5, 180.0);
  const double parts = 180.0 / shell.spacing_deg;
  // The tolerance accepts quotients rounded to six digits.
  if (std::abs(parts - std::round(parts)) > 1e-5 * parts) {
    throw table.error_at("spacing_deg", "does not divide 180 evenly, so the grid lines would not close",
                         fmt::format("choose for example {:.6g}", 180.0 / std::round(parts)));
  }
  shell.spacing_deg = 180.0 / std::round(parts);
  shell.line_width_deg = own_number(table, "line_width_deg", shell.line_width_deg);
  read_color(table, "line_color", shell.line_color);
  read_color(table, "fill_color", shell.fill_color);
  shell.texture = table.text("texture", "");
  shell.line_opacity = own_number(table, "line_opacity", shell.line_opacity);
  shell.fill_opacity = own_number(table, "fill_opacity", shell.texture.empty() ? 0.0 : 1.0);
  shell.exposure = own_number(table, "exposure", shell.exposure);
  table.refuse_unknown_keys();
  return shell;
}

//! Returns the largest horizon radius at any time of the show.
double greatest_horizon(const Show& show) {
  const double least = show_at_least(show).spin;
  const double most = show_at_most(show).spin;
  const bool stops = least < 0.0 && most > 0.0;
  return stops ? horizon_radius(0.0) : std::max(horizon_radius(least), horizon_radius(most));
}

toml::array color_list(const std::array<double, 3>& color) { return toml::array{color[0], color[1], color[2]}; }

}  // namespace

std::vector<ShellSettings> read_shells(TomlTable& root, const std::string& file) {
  std::vector<ShellSettings> shells;
  for (const toml::table* table : root.tables("shells", most_shells)) {
    TomlTable reader(*table, file, name_of(shells.size()));
    shells.push_back(read_shell(reader));
  }
  return shells;
}

void check_shells(TomlTable& root, const std::string& file, const Show& show) {
  const double horizon = greatest_horizon(show);
  const double least = horizon * (1.0 + least_shell_gap);
  const Show smallest = show_at_least(show);
  const auto tables = root.tables("shells", most_shells);
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const double r = smallest.shells[i].radius;
    if (!(r >= least)) {
      const TomlTable reader(*tables[i], file, name_of(i));
      throw reader.error_at(
          "radius",
          fmt::format("is {} M{}, {} the horizon at {:.6g} M", r, r < show.shells[i].radius ? " at some time" : "",
                      r > horizon ? "too close to" : "inside", horizon),
          fmt::format("choose {:.6g} or more", std::ceil(least * 1e5) * 1e-5));
    }
  }
}

toml::array shell_tables(const std::vector<ShellSettings>& shells) {
  toml::array list;
  for (const ShellSettings& shell : shells) {
    list.push_back(toml::table{{"radius", shell.radius},
                               {"spacing_deg", shell.spacing_deg},
                               {"line_width_deg", shell.line_width_deg},
                               {"line_color", color_list(shell.line_color)},
                               {"fill_color", color_list(shell.fill_color)},
                               {"line_opacity", shell.line_opacity},
                               {"fill_opacity", shell.fill_opacity},
                               {"exposure", shell.exposure},
                               {"texture", shell.texture}});
  }
  return list;
}

}  // namespace ergodome
