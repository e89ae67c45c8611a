#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernels/projection/projection.h"

namespace ergodome {

//! World coordinates of a picture as FITS defines them (Calabretta & Greisen 2002): longitude and
//! latitude of the viewer's directions. Forward is longitude 0, latitude 0; longitude grows to the
//! right, latitude upwards.
//!
//! Members are named by their keywords. Pixels of a FITS image count from 1, and its first row is
//! the lowest.
struct PictureWcs {
  //! FITS code of the projection, three letters such as "TAN".
  std::string code;
  std::array<double, 2> crpix;                //!< [px]
  std::array<double, 2> cdelt;                //!< [deg/px] in the plane of projection
  std::array<double, 2> crval;                //!< [deg]
  std::optional<double> lonpole_deg{};        //!< LONPOLE [deg], only for zenithal projections
  std::vector<std::pair<int, double>> pv2{};  //!< (m, value) of each PV2_m keyword
};

//! Returns the world coordinates of a picture. Returns nothing for cubes, and for domes whose
//! viewer is not at the center, for which FITS has no projection.
std::optional<PictureWcs> picture_wcs(const Projection& projection);

}  // namespace ergodome
