#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "content/show/show.h"

namespace ergodome {

//! Arrangement of a film for VR headsets: equirectangular pictures of all elevations.
struct SphericalFilm {
  enum class Eyes { one, top_bottom, left_right };  //!< the left eye's picture is above or at the left
  Eyes eyes = Eyes::one;
  double azimuth_deg = 360.0;  //!< range of azimuth of one eye's picture, symmetric about the front
};

//! Returns the arrangement of a show's film. Returns nothing if players for headsets cannot show it
//! as a sphere: other projections, mirror images, the right eye first, and layouts that mix the
//! rows of both eyes.
std::optional<SphericalFilm> spherical_film(const Show& show);

//! Returns ffmpeg's arguments, before the output file, that add_spherical_metadata() needs.
std::vector<std::string> spherical_arguments(const SphericalFilm& sphere, const std::string& ending);

//! Adds the metadata to a film that ffmpeg has written to `partial`, in the format of `ending`
//! (movie_ending). .mp4, .mov: the boxes st3d and sv3d of Spherical Video V2, and for 360° also
//! those of V1, for older players. .mkv: the element Projection (RFC 9559). Messages name `film`.
//! Throws Error if the film cannot be written or has an unexpected structure.
void add_spherical_metadata(const std::filesystem::path& partial, const std::string& film, const std::string& ending,
                            const SphericalFilm& sphere);

}  // namespace ergodome
