#pragma once

#include <optional>
#include <vector>

#include "render/passes/stars/search/star_finder.h"

// Computes exact lensed images of stars, as a reference.

namespace ergodome {

//! An exact lensed image of a star.
struct ExactImage {
  //! Direction in which the observer sees the image, in the observer's frame.
  Vector3<double> direction;
  double magnification;  //!< solid angle of the image over the star's on the sky, > 0
};

//! Refines approximate lensed images of stars to exact ones with Newton's method on rays in closed
//! form (Gralla & Lupsasca 2020), with derivatives by the view direction from a Taylor series.
//! Independent of the renderer's search for images. An entry is empty if the iteration does not end
//! on the star within `reach` [rad] of the approximate image, or if no light comes from the sky
//! there.
//!
//! `stars[i]`: direction on the sky of the star of image i, in the hole's axes. `found[i]`:
//! direction of the approximate image in the observer's frame.
std::vector<std::optional<ExactImage>> exact_images(const EyeCamera& eye, const std::vector<Vector3<double>>& stars,
                                                    const std::vector<Vector3<double>>& found, double reach);

}  // namespace ergodome
