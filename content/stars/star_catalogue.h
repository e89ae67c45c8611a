#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "content/show/show.h"
#include "kernels/core/vector3.h"

namespace ergodome {

//! A star as catalogues have it. A missing colour is NaN.
struct CatalogueStar {
  std::uint32_t number = 0;  //!< Hipparcos number, or whatever the catalogue counts by
  double ra_deg = 0.0;       //!< J2000, in [0, 360)
  double dec_deg = 0.0;
  float v_mag = 0.0F;
  float b_v = 0.0F;  //!< B-V [mag]
};

//! Rows of a table of which no star was made, for one reason.
struct RowsLeftOut {
  std::string why;  //!< "without a magnitude"
  std::size_t count = 0;
  std::size_t first_line = 0;  //!< of the file
  bool meant = false;          //!< the Sun's, which is no star of the sky
};

//! Stars, brightest first.
struct StarCatalogue {
  std::string name;
  std::vector<CatalogueStar> stars;
  std::vector<RowsLeftOut> left_out;
  std::string read_as;  //!< of a table: which columns were read, and the unit of the right ascension; or empty
};

//! How many rows they are in all.
std::size_t count_of(const std::vector<RowsLeftOut>& left_out);

//! In words: "3 rows skipped: 2 rows without a position (first in line 7), 1 row without a magnitude (line 9)".
std::string text_of(const std::vector<RowsLeftOut>& left_out);

//! Whether other rows are left out than those that are meant to be.
bool lacks_stars(const std::vector<RowsLeftOut>& left_out);

//! Puts the brightest first; stars of equal magnitude stay in their order.
void sort_by_brightness(std::vector<CatalogueStar>& stars);

//! Unit vector of a place on the sky, equatorial J2000: x to the vernal equinox, z to the north celestial pole.
Vector3<double> equatorial_direction(double ra_deg, double dec_deg);

//! Whether a show's word for its stars names no file.
bool is_built_in_catalogue(const std::string& name);

//! Loads the stars of a show: a built-in name ("bright_stars": V <= 6.5, "all_stars"), or the path of a file, relative to the show's
//! folder. Empty when the show has none.
StarCatalogue load_stars(const Show& show);

//! A sentence for the person whose show names a catalogue that holds no star.
std::string note_of_no_stars(const Show& show);

//! The same where rows of it were left out.
std::string note_of_left_out(const Show& show, const std::vector<RowsLeftOut>& left_out);

//! Reads a catalogue from a file of either kind: this project's own (star_file.h), or a table of text (star_table.h).
StarCatalogue read_stars(const std::filesystem::path& path);

}  // namespace ergodome
