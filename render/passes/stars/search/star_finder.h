#pragma once

#include <optional>
#include <vector>

#include "kernels/sky/blackbody.h"
#include "kernels/stars/seen_image.h"
#include "render/lens/grid/grid_tracer.h"
#include "render/lens/stations/lens_position.h"
#include "render/passes/stars/search/patch_search.h"
#include "render/passes/stars/search/star_patches.h"
#include "render/passes/stars/search/view_cone.h"
#include "render/passes/stars/star_eye.h"

namespace ergodome {

//! How a camera moves, which decides how the star grids for its positions are made.
struct CameraCourse {
  //! Many successive positions lie in one cell, whose patches are moved (MovingPatches). Otherwise
  //! a grid is built for each position.
  bool slow = false;
  //! Change of the position from picture to picture, for which the next cell is prepared in the
  //! background; absent: none is prepared.
  std::optional<LensPosition> step{};
};

//! Selects which images to find, and how accurately.
struct StarSettings {
  double pixel = 3e-3;  //!< angle that a pixel of the screen subtends [rad]
  //! Maximum displacement on the screen by the grid next to critical curves [px].
  double grid_px = 0.01;
  //! Grid cells with a smaller area are not split further [px²], see min_star_cell_px().
  double min_cell_px = 2.0;
  float faintest = 1e-11F;    //!< images below this illuminance are omitted [lx]
  ViewCone view{};            //!< images outside this cone may be omitted
  bool redshift = true;       //!< apply frequency shift and beaming
  bool magnification = true;  //!< apply the lens magnification; otherwise images are as bright as the star
  bool about =
      false;  //!< reuse results for similar pixel sizes, for windows whose picture size adapts to the frame time
  CameraCourse course{};
};

//! Returns the minimum cell area of a star grid for a show's lens budget [px²]. At a budget of
//! 0.0625 px, the grid loses none of the images that finer grids find, for 5,000 stars around a
//! hole of spin 0.999. At four times that budget, it loses ten of 8,691 images, all next to the
//! shadow's edge, and building a grid for a new position takes three fifths of the time.
double min_star_cell_px(double budget_px);

//! Returns whether results for one pixel angle [rad] can be used for another: if both are equal or,
//! with `about`, if `found_for` is between half of `pixel` and one percent above it.
bool serves_pixel(double found_for, double pixel, bool about);

//! GPU search, the uploaded patches that it reads, and the joiner of its images.
struct DeviceSearch {
  PatchSearch& search;
  const PlacedPatches& patches;
  ImageJoiner& joiner;
};

//! Builds a lens grid for finding star images. `tracer`, if given, traces the nodes for a single
//! camera. For an ODS eye, the grid covers all of its cameras: an image lies where the camera of
//! its pixel sees the star.
LensStation build_star_station(const StarEye& eye, const StarSettings& settings, GridTracer<float>* tracer = nullptr);

//! Builds the grid of a single camera, with its derivatives along the camera's r and θ.
LensStation build_moving_station(const EyeCamera& eye, const StarSettings& settings,
                                 GridTracer<float>* tracer = nullptr);

//! Inverts a lens grid for an eye at the grid's position. `station` and `settings` must be the same
//! as in the following call of find_star_images().
StarPatches star_patches(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                         const LensStation& station, const StarSettings& settings, PatchRoom& room);
inline StarPatches star_patches(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                                const LensStation& station, const StarSettings& settings) {
  PatchRoom room;
  return star_patches(field, colours, eye, station, settings, room);
}

//! Finds the images of all stars that are in `settings.view` and have an illuminance of at least
//! `settings.faintest`.
//!
//! Approximate positions come from `patches`, which were computed from the grid of `station` (at
//! the eye's position); exact ones come from traced rays. Each image is found once. Where images
//! merge at a caustic, their brightness is limited by the size of the star's disk. If `device` is
//! set, the approximate images are found on a GPU.
std::vector<StarImage> find_star_images(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                                        const LensStation& station, const StarPatches& patches,
                                        const StarSettings& settings, const DeviceSearch* device = nullptr);

//! Does the same as find_star_images(), but leaves the images in GPU memory.
PlacedImages find_star_images_in_place(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                                       const LensStation& station, const StarPatches& patches,
                                       const StarSettings& settings, const DeviceSearch& device);

}  // namespace ergodome
