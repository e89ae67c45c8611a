#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace ergodome {

//! Maximum number of shells in a show.
inline constexpr std::size_t max_shells = 16;

//! Minimum distance of a shell from the horizon, as a fraction of the horizon's radius, because
//! rendering uses floats.
inline constexpr double min_shell_gap = 1e-3;

//! A sphere r = const around the hole, with a grid of parallels and meridians: one of a show's
//! [[shells]].
struct ShellSettings {
  double radius = 10.0;       //!< Boyer-Lindquist radius [M]
  double spacing_deg = 15.0;  //!< angle between grid lines at the shell's center; divides 180
  //! Width of the lines as seen from the center of the shell; 0: no lines.
  double line_width_deg = 1.0;
  std::array<double, 3> line_color = {1.0, 1.0, 1.0};  //!< linear light
  //! Linear light between the lines; multiplies the texture.
  std::array<double, 3> fill_color = {1.0, 1.0, 1.0};
  double line_opacity = 1.0;
  double fill_opacity = 0.0;
  double exposure = 1.0;  //!< factor on all its light
  std::string texture;    //!< equirectangular image, a path relative to the show; empty: none

  bool operator==(const ShellSettings&) const = default;
};

//! Returns true if any part of the shell is visible.
inline bool is_visible(const ShellSettings& shell) {
  return shell.fill_opacity > 0.0 || (shell.line_opacity > 0.0 && shell.line_width_deg > 0.0);
}

}  // namespace ergodome
