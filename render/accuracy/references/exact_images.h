#pragma once

#include <optional>
#include <vector>

#include "render/passes/stars/search/star_finder.h"

// Exact images of stars, as a reference.

namespace ergodome {

//! The exact image of a star.
struct ExactImage {
  Vector3<double> direction;  //!< in the observer's frame
  double magnification;       //!< of the solid angle, positive
};

//! Refines approximate images to exact ones with Newton's method on rays in closed form (Gralla &
//! Lupsasca 2020), with derivatives from a Taylor series. Independent of the search for images. An
//! entry is empty if the iteration does not end on the star within `reach` [rad] of the image, or
//! if no light comes from the sky there.
//!
//! `stars`: their directions on the sky, in the hole's axes.
std::vector<std::optional<ExactImage>> exact_images(const EyeCamera& eye, const std::vector<Vector3<double>>& stars,
                                                    const std::vector<Vector3<double>>& found, double reach);

}  // namespace ergodome
