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

//! Which images to find, and how well.
struct StarSettings {
  double pixel = 3e-3;         //!< angle of a pixel on the screen [rad]
  double grid_px = 0.01;       //!< how far the grid may be wrong next to critical curves [px]
  double least_cell_px = 2.0;  //!< cells of the grid that are smaller are not split, see least_star_cell_px() [px²]
  float faintest = 1e-11F;     //!< illuminance of an image, below which it is left out [lx]
  ViewCone view{};             //!< images outside of it may be left out
  bool redshift = true;        //!< light is shifted and beamed
  bool magnification = true;   //!< images are as bright as the lens makes them; else as bright as the star
  bool about =
      false;  //!< what was found for pixels about as large serves: for windows, whose pictures are as wide as the time allows
};

//! Where a grid for stars ends, for a show's lens budget [px]: at a budget of 0.0625 px no image of 5,000 stars is lost about a hole of spin
//! 0.999 that finer grids have; at four times that ten of 8,691 are, next to the shadow's edge, and a new place takes three fifths of
//! the time.
double least_star_cell_px(double budget_px);

//! Whether what was found for pixels of an angle serves others [rad]: the same, or where `about` says so up to a hundredth smaller and down to half as
//! large.
bool serves_pixel(double found_for, double pixel, bool about);

//! A device's search, with the patches that are searched where it reads them.
struct DeviceSearch {
  PatchSearch& search;
  const PlacedPatches& patches;
};

//! Builds a lens grid that leads to the images of stars. Its nodes are traced by `tracer` if there is one. The grid of an eye
//! that turns with the direction is that of all its cameras together: a pixel's image of a star is where its own camera sees the star.
LensStation build_star_station(const StarEye& eye, const StarSettings& settings, GridTracer<float>* tracer = nullptr);

//! Turns a lens grid round for an eye at its place: `station` and what it is for are those of find_star_images.
StarPatches star_patches(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                         const LensStation& station, const StarSettings& settings, PatchRoom& room);
inline StarPatches star_patches(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                                const LensStation& station, const StarSettings& settings) {
  PatchRoom room;
  return star_patches(field, colours, eye, station, settings, room);
}

//! Finds all images of all stars that shine with the asked illuminance.
//!
//! The grid that `patches` were made of, by `station` (for the eye's own place), says roughly where images are; traced rays say exactly.
//! An image is found once, and images that merge at a caustic are capped by the size of the star's disk.
//!
//! `device` seeks the rough ones, where there is one.
std::vector<StarImage> find_star_images(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                                        const LensStation& station, const StarPatches& patches,
                                        const StarSettings& settings, const DeviceSearch* device = nullptr);

//! The same, where pictures are made.
PlacedImages find_star_images_in_place(const StarField& field, const BlackbodyTable& colours, const StarEye& eye,
                                       const LensStation& station, const StarPatches& patches,
                                       const StarSettings& settings, const DeviceSearch& device, ImageJoiner& joiner);

}  // namespace ergodome
