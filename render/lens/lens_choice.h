#pragma once

#include "kernels/image/shade_pixels.h"
#include "kernels/launch/launch.h"

// Rules for choosing the source of a frame's lens.

namespace ergodome {

//! Frames with fewer pixels are faster without a grid; compare dome_frame/direct and
//! dome_frame/live_grid in tests/bench.
inline constexpr double least_grid_pixels = 150'000.0;

//! Smallest budget [rad] down to which grids can be traced in float.
inline constexpr double finest_float_budget = 2e-5;

//! Returns whether building a grid is cheaper than one ray per pixel. On a GPU it never is.
inline bool is_worth_a_grid(Backend backend, double pixels) {
  return backend == Backend::cpu && pixels >= least_grid_pixels;
}

//! Returns whether a view mode shows properties of the rays. Such modes trace every ray, whatever
//! lens was requested.
inline bool shows_rays(ViewMode mode) {
  return mode == ViewMode::steps || mode == ViewMode::error_estimate || mode == ViewMode::image_order;
}

//! Returns whether a mode is a heat map of the cost of following rays, which includes rays to
//! shells.
inline bool follows_rays(ViewMode mode) { return mode == ViewMode::steps || mode == ViewMode::error_estimate; }

}  // namespace ergodome
