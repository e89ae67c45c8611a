#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace ergodome {

//! Shells that a show may have.
inline constexpr std::size_t most_shells = 16;

//! Shells are no nearer to the horizon than this part of its radius: pictures are made in float.
inline constexpr double least_shell_gap = 1e-3;

//! A sphere r = const about the hole, with a grid of circles of latitude and meridians: one of a show's [[shells]].
struct ShellSettings {
  double radius = 10.0;                                //!< Boyer-Lindquist [M]
  double spacing_deg = 15.0;                           //!< of the grid; divides 180
  double line_width_deg = 1.0;                         //!< as seen from the shell's middle; 0: no lines
  std::array<double, 3> line_color = {1.0, 1.0, 1.0};  //!< linear light
  std::array<double, 3> fill_color = {1.0, 1.0, 1.0};  //!< between the lines; of a texture, a factor
  double line_opacity = 1.0;
  double fill_opacity = 0.0;
  double exposure = 1.0;  //!< factor on all of its light
  std::string texture;    //!< equirectangular image, a path relative to the show; empty: none

  bool operator==(const ShellSettings&) const = default;
};

//! Whether anything of it is seen.
inline bool is_visible(const ShellSettings& shell) {
  return shell.fill_opacity > 0.0 || (shell.line_opacity > 0.0 && shell.line_width_deg > 0.0);
}

}  // namespace ergodome
