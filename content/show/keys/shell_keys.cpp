#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "content/show/animated_show.h"
#include "content/show/show_schema.h"
#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

std::string name_of(std::size_t shell) { return fmt::format("shells[{}]", shell); }

//! Returns true if a number of a shell is 0 and not animated. `value` is its value, `key` its name.
bool is_never(const Show& show, const ShellSettings& shell, double value, const char* key) {
  const auto i = static_cast<std::size_t>(&shell - show.shells.data());
  return value <= 0.0 && find_animation(show, fmt::format("{}.{}", name_of(i), key)) == nullptr;
}

constexpr auto unused_without_width = [](const Show& show, const ShellSettings& shell) {
  return is_never(show, shell, shell.line_width_deg, "line_width_deg") ? "has no effect while line_width_deg is 0"
                                                                       : nullptr;
};

constexpr auto unused_without_opacity = [](const Show& show, const ShellSettings& shell) {
  return unused_without_width(show, shell) == nullptr && is_never(show, shell, shell.line_opacity, "line_opacity")
             ? "has no effect while line_opacity is 0"
             : nullptr;
};

constexpr auto unused_without_lines = [](const Show& show, const ShellSettings& shell) {
  const char* const no_width = unused_without_width(show, shell);
  return no_width != nullptr ? no_width : unused_without_opacity(show, shell);
};

constexpr auto unused_without_fill = [](const Show& show, const ShellSettings& shell) {
  return is_never(show, shell, shell.fill_opacity, "fill_opacity") ? "has no effect while fill_opacity is 0" : nullptr;
};

constexpr auto make_lines_close = [](const TomlTable& table, ShellSettings& shell) {
  const double parts = 180.0 / shell.spacing_deg;
  // The tolerance accepts quotients rounded to six digits.
  if (std::abs(parts - std::round(parts)) > 1e-5 * parts) {
    throw table.error_at("spacing_deg", "does not divide 180 evenly, so the grid lines would not close",
                         fmt::format("choose for example {:.6g}", 180.0 / std::round(parts)));
  }
  shell.spacing_deg = 180.0 / std::round(parts);
};

constexpr auto keys_of_shell = keys_of<ShellSettings>(
    key<&ShellSettings::radius>("radius", "Radius of the sphere; at least 1.001 times the radius of the horizon.")
        .range(1.0, 1e9, "M")
        .required("give the radius of the shell in units of M, for example radius = 10")
        .animated(),
    key<&ShellSettings::spacing_deg>("spacing_deg", "Angle between neighboring lines.")
        .range(0.5, 180.0, "deg")
        .after(make_lines_close)
        .unused_if(unused_without_lines)
        .page({.bounds = "0.5 to 180, divides 180"}),
    key<&ShellSettings::line_width_deg>("line_width_deg", "Width of the lines, the same at all latitudes. 0: no lines.")
        .range(0.0, 90.0, "deg")
        .animated()
        .unused_if(unused_without_opacity),
    key<&ShellSettings::line_color>("line_color", "Color of the lines: red, green, blue in linear light.")
        .range(0.0, 1e6, "display white")
        .unused_if(unused_without_lines),
    key<&ShellSettings::fill_color>("fill_color", "Color between the lines. With a texture, a factor on its color.")
        .range(0.0, 1e6, "display white")
        .unused_if(unused_without_fill),
    key<&ShellSettings::texture>("texture", "[Image](#texture) on the sphere, relative to the folder of the show.")
        .unused_if(unused_without_fill)
        .page({.type = "path", .otherwise = "none"}),
    key<&ShellSettings::line_opacity>("line_opacity", "Opacity of the lines at each crossing.")
        .range(0.0, 1.0)
        .animated()
        .unused_if(unused_without_width),
    key<&ShellSettings::fill_opacity>("fill_opacity", "Opacity between the lines at each crossing.")
        .range(0.0, 1.0)
        .animated()
        .before([](const TomlTable& /*table*/, ShellSettings& shell) {
          shell.fill_opacity = shell.texture.empty() ? 0.0 : 1.0;
        })
        .page({.otherwise = "0; 1 with `texture`"}),
    key<&ShellSettings::exposure>("exposure", "Factor on all light of the shell.").range(0.0, 1e12).animated());

//! Returns the largest horizon radius at any time of the show.
double max_horizon(const Show& show) {
  const Spacetime minimum = spacetime_of(show_at_least(show));
  const Spacetime maximum = spacetime_of(show_at_most(show));
  const bool stops = minimum.spin < 0.0 && maximum.spin > 0.0;
  return stops ? horizon_radius(Spacetime{}) : std::max(horizon_radius(minimum), horizon_radius(maximum));
}

}  // namespace

constinit const KeyTable<ShellSettings> shell_keys = keys_of_shell;

void check_shells(TomlTable& root, const std::string& file, const Show& show) {
  const double horizon = max_horizon(show);
  const double minimum = horizon * (1.0 + min_shell_gap);
  const Show smallest = show_at_least(show);
  const auto tables = root.tables("shells", max_shells);
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const double r = smallest.shells[i].radius;
    if (!(r >= minimum)) {
      const TomlTable reader(*tables[i], file, name_of(i));
      throw reader.error_at(
          "radius",
          fmt::format("is {} M{}, {} the horizon at {:.6g} M", r, r < show.shells[i].radius ? " at some time" : "",
                      r > horizon ? "too close to" : "inside", horizon),
          fmt::format("choose {:.6g} or more", std::ceil(minimum * 1e5) * 1e-5));
    }
  }
}

}  // namespace ergodome
