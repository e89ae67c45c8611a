#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernels/projection/projection.h"

namespace ergodome {

//! World coordinates of a picture as FITS has them (Calabretta & Greisen 2002): longitude and latitude of the directions in which its viewer
//! looks. Longitude 0, latitude 0 is forward; longitude grows to the right, latitude upwards.
//!
//! Numbers are named by their keywords. Pixels of a FITS image count from 1, and its first row is the lowest.
struct PictureWcs {
  std::string code;                           //!< of the projection, three letters: "TAN"
  std::array<double, 2> crpix;                //!< [px]
  std::array<double, 2> cdelt;                //!< [deg/px] in the plane of projection
  std::array<double, 2> crval;                //!< [deg]
  std::optional<double> lonpole_deg{};        //!< of zenithal projections
  std::vector<std::pair<int, double>> pv2{};  //!< PV2_m
};

//! Returns the world coordinates of a picture; nothing for cubes, and for domes seen from beside their middle, which FITS has no projection for.
std::optional<PictureWcs> picture_wcs(const Projection& projection);

}  // namespace ergodome
