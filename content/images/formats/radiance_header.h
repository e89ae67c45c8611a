#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace ergodome {

//! Exposure and color metadata in the header of a Radiance picture (Ward, "Radiance file formats", refman/filefmts).
struct RadianceHeader {
  //! Factors from the file's numbers to light: 1 / (product of all EXPOSURE and COLORCORR lines).
  std::array<float, 3> gains = {1.0F, 1.0F, 1.0F};
  std::optional<std::array<double, 8>> primaries;  //!< xy of red, green, blue and white, unless they are the usual ones
  bool is_xyz = false;  //!< the pixels are CIE XYZ, with (1, 1, 1) for white as Radiance's ra_xyze writes them
  std::string problem;  //!< what cannot be shown right; empty if nothing
};

//! Reads the header at the beginning of a file. Other files than Radiance's have gains of 1 and no problem.
RadianceHeader read_radiance_header(std::string_view head);

}  // namespace ergodome
