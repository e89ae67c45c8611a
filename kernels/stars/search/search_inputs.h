#pragma once

#include <cmath>

#include "kernels/stars/search/corrected_leaf.h"
#include "kernels/stars/search/patch_pairs.h"
#include "kernels/stars/search/star_bands.h"

// Inputs of the search for images of stars, on CPU and GPU.
namespace ergodome {

//! A view as a cone in the observer's frame, with a unit vector as its axis.
struct ViewCone {
  Vector3<double> axis = {1.0, 0.0, 0.0};
  double half_angle = 3.14159265358979323846;  //!< half angle of the cone [rad]
  double cosine = -1.0;                        //!< cosine of half_angle
};

//! Inputs of the search for images of stars in the patches of a lens.
struct SearchInputs {
  const StarPatch* patches;
  int patch_count;
  int sides;       //!< 2 if the grid covers half of a sky that is its own mirror image, else 1
  float faintest;  //!< star images of lower illuminance at the camera are omitted [lx]
  CorrectedLeaves corrected;
  SearchedField field;
  ViewCone view;     //!< images outside this cone may be omitted
  SkyRotation turn;  //!< rotation from the patches' azimuth, φ = 0, to the camera's
};

inline namespace ERGO_TARGET {

//! Returns whether the cone around `axis` (unit vector) with half angle `radius` [rad] may overlap
//! the view.
ERGO_HD bool may_touch(const ViewCone& view, const Vector3<double>& axis, double radius) {
  const double along = dot(view.axis, axis);
  if (along >= view.cosine) {
    return true;
  }
  // A cosine falls by at most as much as the angle grows, so most calls need to compute no cosine.
  const double reach = view.half_angle + radius;
  return reach >= 3.14159265358979323846 || (along >= view.cosine - radius && along >= ::cos(reach));
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
