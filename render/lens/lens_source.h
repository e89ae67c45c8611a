#pragma once

#include "kernels/image/lens_pixels.h"
#include "kernels/image/shade_pixels.h"
#include "kernels/launch/launch.h"

// The interface of all lens sources, and rules for choosing one.

namespace ergodome {

//! The source of a frame's lens: baked stations (`streamed`), a grid built for the frame (`live`),
//! or one ray per pixel (`direct`). `automatic` chooses the cheapest source with the requested
//! accuracy.
enum class LensChoice { automatic, streamed, live, direct };

//! A lens: maps the pixels of one eye's frame to directions on the sky.
class LensSource {
 public:
  LensSource() = default;
  virtual ~LensSource() = default;
  LensSource(const LensSource&) = delete;
  LensSource& operator=(const LensSource&) = delete;

  //! Fills the channels of rows [first_row, first_row + row_count) with row_count * width elements
  //! each, in the backend's memory.
  virtual void fill(int first_row, int row_count, const LensPixels& out) const = 0;

  //! Fills the channels of rows of a picture and shades them at once, if that is cheaper: without
  //! writing `shading.lens`. Otherwise returns false and does nothing.
  virtual bool shade([[maybe_unused]] int first_row, [[maybe_unused]] int row_count,
                     [[maybe_unused]] const ShadeBatch& shading) const {
    return false;
  }

  //! Returns the name of the source for display: "direct", "live", "streamed" or "quadtree".
  [[nodiscard]] virtual const char* name() const = 0;

  //! Returns whether the lens is that of an earlier camera position, because the lens of the
  //! current one was not ready in time.
  [[nodiscard]] virtual bool behind() const { return false; }
};

//! Frames with fewer pixels may be faster without a grid: domes are not, but windows see only a part
//! of the sky of a grid. Compare dome_frame/direct and dome_frame/live_grid in tests/bench. The grid
//! of an ODS eye costs more.
inline constexpr double min_grid_pixels = 10'000.0;
inline constexpr double min_omni_grid_pixels = 150'000.0;

//! Smallest budget of displacements on the screen [rad] for which float rays are accurate enough to
//! build a grid.
inline constexpr double finest_float_budget = 2e-5;

//! Returns whether building a grid is cheaper than one ray per pixel. On a GPU it never is. `omni`:
//! for an ODS eye.
inline bool is_worth_a_grid(Backend backend, double pixels, bool omni = false) {
  return backend == Backend::cpu && pixels >= (omni ? min_omni_grid_pixels : min_grid_pixels);
}

//! Returns whether a view mode shows properties of the rays. In such modes every ray is traced,
//! whatever lens was requested.
inline bool shows_rays(ViewMode mode) {
  return mode == ViewMode::steps || mode == ViewMode::error_estimate || mode == ViewMode::image_order;
}

//! Returns whether a view mode is a heat map of the cost of tracing, in which rays are followed to
//! shells as well.
inline bool follows_rays(ViewMode mode) { return mode == ViewMode::steps || mode == ViewMode::error_estimate; }

}  // namespace ergodome
