#pragma once

#include <limits>
#include <vector>

#include "kernels/projection/projection.h"
#include "kernels/stars/star_point.h"
#include "kernels/stars/star_region.h"
#include "render/eyes/eye_camera.h"
#include "render/passes/stars/drawing/star_trails.h"

namespace ergodome {

//! Settings for drawing points on pixels.
struct SplatSettings {
  //! Standard deviation of the Gaussian spot; 0 draws each image on a single pixel.
  double sigma_px = 0.0;
  float scale = 1.0F;  //!< picture value of a luminance of 1 cd/m²
  //! Minimum illuminance of star images that have spikes [lx].
  float spikes_from = std::numeric_limits<float>::infinity();
  float spike_strength = 0.0F;  //!< fraction of the light of such images that goes into spikes
  double spike_reach_px = 0.0;
  double cutoff_px = 0.0;  //!< radius at which the Gaussian ends; 0: three sigma

  //! Returns how far from its center the light of a point may reach [px]: a pixel more than the
  //! radius at which the Gaussian ends.
  [[nodiscard]] double reach_px() const;
};

//! Returns the settings scaled to a picture. Except on flat screens, spots are specified in pixels
//! of a 4k dome (π / 4096 rad). In finer pictures they keep that angle, because smaller spots would
//! be invisible in a dome, as far as widest_splat_px allows. Does not change them on flat screens.
SplatSettings scaled_to(const SplatSettings& settings, const Projection& projection);

//! Returns the regions of a picture (PictureRegion), on which star images become points.
std::vector<StarRegion> star_regions(const Projection& projection, const SplatSettings& settings);

//! Order of the points: sorted by row for splat_points(), or as the images are ordered, which
//! suffices for TiledStars.
enum class PointOrder { by_row, of_images };

//! Returns the points of all images that lie in a picture, or so close to its edge that their light
//! reaches it.
//!
//! Near the edge of a cube face, an image yields a point on each face that its light may reach.
//!
//! The value of a point on a pixel is the illuminance divided by the pixel's solid angle, which is
//! a luminance like that of the sky map.
std::vector<StarPoint> star_points(const std::vector<StarImage>& images, const EyeCamera& eye,
                                   const Projection& projection, const SplatSettings& settings,
                                   PointOrder order = PointOrder::by_row);

//! Returns the points of image trails during an exposure. Each trail becomes a row of points that
//! share its light.
std::vector<StarPoint> trail_points(const StarTrails& trails, const Shutter& shutter, const Projection& projection,
                                    const SplatSettings& settings, PointOrder order = PointOrder::by_row);

//! Adds points, sorted by row from the top, to rows [first_row, first_row + row_count) of a picture
//! in host memory: four floats per pixel, linear light. The weights of a point's pixels add up to 1
//! for any subpixel position, so its total light depends neither on the spread nor on the
//! resolution.
void splat_points(const std::vector<StarPoint>& points, const Projection& projection, const SplatSettings& settings,
                  int first_row, int row_count, float* rgba);

}  // namespace ergodome
