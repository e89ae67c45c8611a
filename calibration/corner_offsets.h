#pragma once

#include <array>

#include "calibration/blend_map.h"
#include "calibration/projector_optics.h"
#include "calibration/warp_mesh.h"

// A projector that was nudged: its picture is pulled back into place by its four corners, bilinearly in between.
namespace ergodome {

//! Corners of a raster, clockwise.
enum class Corner { top_left, top_right, bottom_right, bottom_left };

//! How far each corner of a raster is moved: parts of its width to the right, of its height downwards.
struct CornerOffsets {
  //! Most that a corner may move: whatever the other three do, places stay apart from one another.
  static constexpr double farthest = 0.25;

  std::array<double, 4> right{};
  std::array<double, 4> down{};

  [[nodiscard]] bool none() const { return *this == CornerOffsets{}; }
  friend bool operator==(const CornerOffsets&, const CornerOffsets&) = default;
};

//! Where a place of the raster comes to be. Places beyond its rim go on in the same way.
RasterPlace moved_place(const CornerOffsets& corners, const RasterPlace& place);

//! The inverse, to 1e-9, for offsets up to CornerOffsets::farthest and places on the raster.
RasterPlace moved_back(const CornerOffsets& corners, const RasterPlace& place);

//! A warp whose nodes are moved.
WarpMesh moved_warp(const CornerOffsets& corners, const WarpMesh& mesh);

//! A mask that goes with the warp: each pixel holds what was at the place that is moved there, the rim's value where that is beyond it.
BlendMap moved_mask(const CornerOffsets& corners, const BlendMap& mask);

}  // namespace ergodome
