#pragma once

#include <vector>

#include "kernels/sky/blackbody.h"
#include "kernels/stars/seen_image.h"
#include "render/lens/grid/grid_tracer.h"
#include "render/passes/stars/search/patch_search.h"
#include "render/passes/stars/search/star_patches.h"
#include "render/passes/stars/search/view_cone.h"
#include "render/passes/stars/star_eye.h"

namespace ergodome {

//! Selects which images to find, and how accurately.
struct StarSettings {
  double pixel = 3e-3;         //!< angle of a pixel on the screen [rad]
  double grid_px = 0.01;       //!< maximum error of the grid next to critical curves [px]
  double least_cell_px = 2.0;  //!< area of grid cells that are not split further [px²], see least_star_cell_px()
  float faintest = 1e-11F;     //!< images below this illuminance are omitted [lx]
  ViewCone view{};             //!< images outside may be omitted
  bool redshift = true;        //!< apply frequency shift and beaming
  bool magnification = true;   //!< apply the lens magnification; otherwise images are as bright as the star
  bool about =
      false;  //!< reuse results for similar pixel sizes, for windows whose picture size adapts to the frame time
};

//! Returns the smallest cell area of a star grid for a show's lens budget [px²]. At a budget of
//! 0.0625 px, none of the images of 5,000 stars around a hole of spin 0.999 that finer grids find
//! is lost. At four times that budget, ten of 8,691 images are lost, next to the shadow's edge, and
//! a grid for a new position takes three fifths of the time.
double least_star_cell_px(double budget_px);

//! Returns whether results for one pixel angle can be used for another [rad]: if they are equal or,
//! with `about`, if the results are for a pixel between half the size and one percent larger.
bool serves_pixel(double found_for, double pixel, bool about);

//! GPU search and the uploaded patches that it reads.
struct DeviceSearch {
  PatchSearch& search;
  const PlacedPatches& patches;
};

//! Builds a lens grid for finding star images. `tracer`, if given, traces its nodes. For an ODS
//! eye, the grid covers all of its cameras: an image lies where the camera of its pixel sees the
//! star.
LensStation build_star_station(const StarEye& eye, const StarSettings& settings, GridTracer<float>* tracer = nullptr);

//! Inverts a lens grid for an eye at its position. `station` and `settings` must be those that
//! find_star_images gets.
StarPatches star_patches(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                         const LensStation& station, const StarSettings& settings, PatchRoom& room);
inline StarPatches star_patches(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                                const LensStation& station, const StarSettings& settings) {
  PatchRoom room;
  return star_patches(field, colours, eye, station, settings, room);
}

//! Finds all images of all stars whose illuminance is at least `settings.faintest`.
//!
//! The grid of `station` (at the eye's position), of which `patches` were made, gives approximate
//! positions; traced rays give exact ones. Each image is found once. Where images merge at a
//! caustic, their brightness is limited by the size of the star's disk.
//! `device`, if given, finds the approximate images on a GPU.
std::vector<StarImage> find_star_images(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                                        const LensStation& station, const StarPatches& patches,
                                        const StarSettings& settings, const DeviceSearch* device = nullptr);

//! Does the same, but leaves the images in GPU memory.
PlacedImages find_star_images_in_place(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                                       const LensStation& station, const StarPatches& patches,
                                       const StarSettings& settings, const DeviceSearch& device, ImageJoiner& joiner);

}  // namespace ergodome
