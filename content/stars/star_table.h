#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "content/stars/star_catalogue.h"

namespace ergodome {

//! Reads a star table from text: the project's own tables, and those of HYG, Gaia's archive,
//! VizieR, TOPCAT, AstroPy (ECSV), Stellarium and spreadsheets. Also reads gzip and UTF-16
//! (table_text.h). Cells are separated by commas, semicolons, tabs, bars or spaces. The first line
//! that is not a comment names the columns in any order (column_names.h); other columns are
//! ignored. Coordinates may be sexagesimal (sky_angle.h).
//!
//! Skips rows whose position or magnitude is empty or not a number, HYG's row of the Sun (dist = 0,
//! brighter than -20), and lines that look like rows but are inside a cell's quotes; counts them by
//! reason. A missing color stays NaN; colors beyond 20 become NaN, because catalogs write 99 for
//! unknown ones.
//!
//! Throws Error with file and line for text in place of a number, unclosed quotes, positions off
//! the sphere, and magnitudes outside -30 to 60.
StarCatalogue read_star_table(const std::filesystem::path& path);

//! Reads a star table from a stream; `file` is its name in messages.
StarCatalogue parse_star_table(std::istream& stream, const std::string& file);

}  // namespace ergodome
