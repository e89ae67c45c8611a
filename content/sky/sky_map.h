#pragma once

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <string>

#include "content/show/show.h"
#include "content/sky/environment_image.h"

namespace ergodome {

//! Returns the folder with the built-in maps and shows: $ERGODOME_CONTENT, or that of the
//! installation (../share/ergodome/content beside the program), or that of the source tree. Throws
//! Error if it has no maps.
std::filesystem::path built_in_content_folder();

//! Returns true if a show's value for `map` is a built-in name, not a file.
bool is_built_in_sky(const std::string& name);

//! Loads the sky map of a show: a built-in name ("milky_way", "grid", "black") or a path, relative
//! to the show's folder. Flips a map with a mirrored layout from left to right. Throws Error if the
//! image cannot be read.
EnvironmentImage load_sky_map(const Show& show);

//! Returns a test sky for distortion: lines every 15° of latitude and longitude, a hue for each
//! quadrant, bright in the north and dark in the south, a white ring at the north pole and a red
//! one at the south pole.
EnvironmentImage make_grid_sky(int width);

//! Returns a sky without light, so that only stars and objects near the hole are visible.
EnvironmentImage make_black_sky();

//! Returns the rotation from equatorial J2000 (x to the vernal equinox, z to the north celestial
//! pole) to the hole's sky axes (z = spin axis).
//!
//! The spin axis points at the given right ascension and declination. The sky's x axis lies in the
//! plane of the spin axis and the celestial pole, away from the pole. The built-in grid uses the
//! hole's own axes, so it and the stars shown with it are not rotated.
glm::dmat3 sky_from_equatorial(const SkySettings& sky);

//! Returns the rotation from a map's axes to the hole's sky axes. The map's axes are equatorial
//! J2000, unless its layout defines others.
glm::dmat3 sky_from_map(const SkySettings& sky);

//! Returns the direction, in map axes, of a texel's position (u to the right, v down, both 0 to 1):
//! longitude is 90° at the left edge and decreases to the right, as seen from inside the sphere
//! with north up.
glm::dvec3 direction_from_map(double u, double v);

//! Returns the position (u, v) of a direction: the inverse of direction_from_map().
glm::dvec2 map_from_direction(const glm::dvec3& direction);

}  // namespace ergodome
