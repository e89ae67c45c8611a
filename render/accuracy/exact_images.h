#pragma once

#include <optional>
#include <vector>

#include "render/passes/stars/search/star_finder.h"

namespace ergodome {

//! Where an image of a star is exactly.
struct ExactImage {
  Vector3<double> direction;  //!< in the observer's frame
  double magnification;       //!< of the solid angle, positive
};

//! Follows images that somebody has found to where they are: Newton's method on rays in closed form (Gralla & Lupsasca 2020), the derivatives
//! from a Taylor series. It shares nothing with the search for them. Nothing where it does not end on the star within `reach` [rad] of the
//! image, or where there is no light from the sky.
//!
//! `stars`: their directions on the sky, in the hole's axes.
std::vector<std::optional<ExactImage>> exact_images(const EyeCamera& eye, const std::vector<Vector3<double>>& stars,
                                                    const std::vector<Vector3<double>>& found, double reach);

}  // namespace ergodome
