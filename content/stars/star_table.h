#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "content/stars/star_catalogue.h"

namespace ergodome {

//! Reads a table of stars as text: our own, and those of HYG, Gaia's archive, VizieR, TOPCAT, AstroPy (ECSV), Stellarium and spreadsheets.
//! gzip and UTF-16 are read as well (table_text.h). Cells are separated by commas, semicolons, tabs, bars or spaces; the first line that
//! is no comment names the columns (table_columns.h), in any order, others are ignored. Coordinates may be sexagesimal (sky_angle.h).
//! Rows whose place or magnitude is empty or not a number are left out and counted by cause; so are HYG's own row of the Sun (dist = 0, brighter than -20)
//! and lines like rows that a cell's quotes have swallowed. A missing colour stays NaN, and so does one beyond 20: catalogues write 99 for what is not known.
//! Throws Error with file and line for text where a number should be, quotes that are not closed, places off the sphere, and magnitudes beyond -30 to 60.
StarCatalogue read_star_table(const std::filesystem::path& path);

//! The same from a stream; `file` goes into errors.
StarCatalogue parse_star_table(std::istream& stream, const std::string& file);

}  // namespace ergodome
