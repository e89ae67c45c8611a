#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace ergodome {

//! Exposure and color metadata in the header of a Radiance image file (Ward, "Radiance file
//! formats", refman/filefmts).
struct RadianceHeader {
  //! Factors from the file's numbers to light: 1 / (product of all EXPOSURE and COLORCORR lines).
  std::array<float, 3> gains = {1.0F, 1.0F, 1.0F};
  //! xy of red, green, blue and white, if they are unusual; of X, Y, Z and white if `is_xyz`.
  std::optional<std::array<double, 8>> primaries;
  bool is_xyz = false;  //!< the pixels are CIE XYZ with a white of (1, 1, 1), as Radiance's ra_xyze writes them
  std::string problem;  //!< what cannot be shown correctly; empty if nothing
};

//! Reads the header at the beginning of a file. For files of other formats, all gains are 1 and
//! `problem` is empty.
RadianceHeader read_radiance_header(std::string_view head);

}  // namespace ergodome
