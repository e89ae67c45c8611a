#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "content/show/show.h"
#include "kernels/core/vector3.h"

namespace ergodome {

//! A star of a catalog. A missing color is NaN.
struct CatalogueStar {
  std::uint32_t number = 0;  //!< Hipparcos number, or the number in another catalog
  double ra_deg = 0.0;       //!< J2000, in [0, 360)
  double dec_deg = 0.0;
  float v_mag = 0.0F;
  float b_v = 0.0F;  //!< B-V [mag]
};

//! Table rows that were skipped for one reason.
struct RowsLeftOut {
  std::string why;  //!< "without a magnitude"
  std::size_t count = 0;
  std::size_t first_line = 0;  //!< line of the first of these rows in the file
  bool meant = false;          //!< true if the rows were skipped on purpose: the row of the Sun
};

//! A star catalog, brightest star first.
struct StarCatalogue {
  std::string name;
  std::vector<CatalogueStar> stars;
  std::vector<RowsLeftOut> left_out;
  //! If read from a table: the columns used and the unit of the right ascension; otherwise empty.
  std::string read_as;
};

//! Returns the total number of skipped rows.
std::size_t count_of(const std::vector<RowsLeftOut>& left_out);

//! Returns a text such as "3 rows skipped: 2 rows without a position (first in line 7), 1 row
//! without a magnitude (line 9)".
std::string text_of(const std::vector<RowsLeftOut>& left_out);

//! Returns true if any row was skipped that should hold a star.
bool lacks_stars(const std::vector<RowsLeftOut>& left_out);

//! Sorts stars by brightness, brightest first; stars of equal magnitude keep their order.
void sort_by_brightness(std::vector<CatalogueStar>& stars);

//! Returns the unit vector of a position on the sky, equatorial J2000: x to the vernal equinox, z
//! to the north celestial pole.
Vector3<double> equatorial_direction(double ra_deg, double dec_deg);

//! Returns true if a show's value for `stars` is a built-in name or empty, not a file.
bool is_built_in_catalogue(const std::string& name);

//! Loads the stars of a show: a built-in name ("bright_stars": V <= 6.5, "all_stars"), or the path
//! of a file, relative to the show's folder. Returns an empty catalog if the show has no stars.
StarCatalogue load_stars(const Show& show);

//! Returns a note that the catalog of a show contains no stars.
std::string note_of_no_stars(const Show& show);

//! Returns a note about rows of a show's catalog that were skipped, except those skipped on purpose
//! (RowsLeftOut::meant).
std::string note_of_left_out(const Show& show, const std::vector<RowsLeftOut>& left_out);

//! Reads a catalog from a file in the project's own format (star_file.h) or a text table
//! (star_table.h).
StarCatalogue read_stars(const std::filesystem::path& path);

}  // namespace ergodome
