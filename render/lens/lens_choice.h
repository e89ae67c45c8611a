#pragma once

#include "kernels/image/shade_pixels.h"
#include "kernels/launch/launch.h"

namespace ergodome {

//! Below this many pixels a grid is not worth its while; compare dome_frame/direct and dome_frame/live_grid in tests/bench.
inline constexpr double least_grid_pixels = 150'000.0;

//! Float traces grids well down to this budget [rad].
inline constexpr double finest_float_budget = 2e-5;

//! Whether a picture is cheaper by a grid that has to be made first. On a GPU a ray a pixel is cheap.
inline bool is_worth_a_grid(Backend backend, double pixels) {
  return backend == Backend::cpu && pixels >= least_grid_pixels;
}

//! Views that show what rays do trace them, whatever lens is asked for.
inline bool shows_rays(ViewMode mode) {
  return mode == ViewMode::steps || mode == ViewMode::error_estimate || mode == ViewMode::image_order;
}

}  // namespace ergodome
