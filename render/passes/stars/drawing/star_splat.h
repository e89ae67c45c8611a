#pragma once

#include <limits>
#include <vector>

#include "kernels/projection/projection.h"
#include "kernels/stars/star_point.h"
#include "kernels/stars/star_sheet.h"
#include "render/eyes/eye_camera.h"
#include "render/passes/stars/drawing/star_trails.h"

namespace ergodome {

//! How points become pixels.
struct SplatSettings {
  double sigma_px = 0.0;  //!< of a Gaussian; 0: each image in the pixel that it falls on
  float scale = 1.0F;     //!< picture value of a luminance of 1 cd/m²
  float spikes_from = std::numeric_limits<float>::infinity();  //!< illuminance of the images that have spikes [lx]
  float spike_strength = 0.0F;                                 //!< part of their light that is in these
  double spike_reach_px = 0.0;
  double cutoff_px = 0.0;  //!< where the Gaussian ends; 0: at three sigma

  //! How far from its middle a point may reach.
  [[nodiscard]] double reach_px() const;
};

//! The same for a picture: a spot of a dome or a whole sky is given in pixels of 4k ones, and keeps its angle in finer ones, where it
//! would shrink below what an eye in the dome can tell from nothing. None reaches beyond widest_splat_px.
SplatSettings scaled_to(const SplatSettings& settings, const Projection& projection);

//! The sheets of a picture, on which points are made of images.
std::vector<StarSheet> star_sheets(const Projection& projection, const SplatSettings& settings);

//! In which order points are: as splat_points() wants them, or as their images came, which is all that TiledStars asks.
enum class PointOrder { by_row, of_images };

//! The images that lie in a picture or beside it.
//!
//! An image near the edge of a cube's face is there once for each face that its light may reach.
//! A pixel receives the illuminance that falls on it over its solid angle, which is a luminance like that of the map.
std::vector<StarPoint> star_points(const std::vector<StarImage>& images, const EyeCamera& eye,
                                   const Projection& projection, const SplatSettings& settings,
                                   PointOrder order = PointOrder::by_row);

//! The same for images on their way while a shutter is open, each a row of points that share its light.
std::vector<StarPoint> trail_points(const StarTrails& trails, const Shutter& shutter, const Projection& projection,
                                    const SplatSettings& settings, PointOrder order = PointOrder::by_row);

//! Adds points, given row by row from the top, to rows [first_row, first_row + row_count) of a picture in host memory: four floats a pixel, linear light. The weights of
//! a point's pixels add up to 1, wherever between pixels it lies: its light does not depend on the spread, nor on the resolution.
void splat_points(const std::vector<StarPoint>& points, const Projection& projection, const SplatSettings& settings,
                  int first_row, int row_count, float* rgba);

}  // namespace ergodome
