#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "content/stars/star_catalogue.h"

namespace ergodome {

//! Reads a table of stars from text: the project's own tables, and those of HYG, Gaia's archive,
//! VizieR, TOPCAT, AstroPy (ECSV), Stellarium and spreadsheets. Also reads gzip and UTF-16
//! (table_text.h). Commas, semicolons, tabs, bars or spaces separate cells. The first line that is
//! no comment names the columns in any order (column_names.h); other columns are ignored.
//! Coordinates may be sexagesimal (sky_angle.h).
//!
//! Leaves out rows whose position or magnitude is empty or not a number, HYG's row of the Sun
//! (dist = 0, brighter than -20), and lines like rows that a cell's quotes have swallowed; counts
//! them by cause. A missing colour stays NaN, and so does one beyond 20, because catalogues write
//! 99 for an unknown one.
//!
//! Throws Error with file and line for text where a number should be, quotes that are not closed,
//! positions off the sphere, and magnitudes beyond -30 to 60.
StarCatalogue read_star_table(const std::filesystem::path& path);

//! The same from a stream; `file` goes into errors.
StarCatalogue parse_star_table(std::istream& stream, const std::string& file);

}  // namespace ergodome
