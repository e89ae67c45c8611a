#pragma once

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <string>

#include "content/show/show.h"
#include "content/sky/environment_image.h"

namespace ergodome {

//! A folder with the built-in maps and shows: $ERGODOME_CONTENT, or beside the program, or the source folder it was built from.
std::filesystem::path built_in_content_folder();

//! Whether a show's word for its map names no file.
bool is_built_in_sky(const std::string& name);

//! Loads the sky map of a show: a built-in name ("milky_way", "grid", "black") or a path, relative to the show's folder. The rows of a map that its
//! layout calls mirrored are turned round.
EnvironmentImage load_sky_map(const Show& show);

//! A sky to judge distortion by: lines every 15° of latitude and longitude, a hue for each quadrant, light in the north and dark in
//! the south, a white ring at the north pole and a red one at the south pole.
EnvironmentImage make_grid_sky(int width);

//! A sky without any light: stars, or what stands near the hole, are all there is to see.
EnvironmentImage make_black_sky();

//! Rotation from equatorial J2000 (x to the vernal equinox, z to the north celestial pole) to the hole's sky axes (z = spin axis).
//!
//! The spin axis points at the given right ascension and declination, and the sky's x axis lies in the plane of the spin axis and the celestial
//! pole, away from the pole. The built-in grid is drawn in the hole's own axes and is not turned, nor are stars beside it.
glm::dmat3 sky_from_equatorial(const SkySettings& sky);

//! Rotation from a map's axes to the hole's sky axes: those of equatorial J2000, unless its layout says otherwise.
glm::dmat3 sky_from_map(const SkySettings& sky);

//! Map axes direction of a map's texel position (u to the right, v down, both 0 to 1): longitude is 90° at the left edge and
//! falls to the right, as seen from inside the sphere with north up.
glm::dvec3 direction_from_map(double u, double v);

//! The inverse: (u, v) of a direction.
glm::dvec2 map_from_direction(const glm::dvec3& direction);

}  // namespace ergodome
