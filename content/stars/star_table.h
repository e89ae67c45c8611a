#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "content/stars/star_catalogue.h"

namespace ergodome {

//! Reads a table of stars as comma-separated text, columns named in its first line, in any order, others ignored:
//!   ra_deg [deg] (or ra, in hours, as HYG has it), dec_deg or dec [deg], v_mag, Vmag or mag, and where they are known b_v, B-V or ci, and
//!   hip or id; in capitals or not.
//! Rows whose place or magnitude is empty or not a number are left out and counted by cause; so are HYG's own row of the Sun (dist = 0, brighter than -20)
//! and lines like rows that a cell's quotes have swallowed. A missing colour stays NaN, and so does one beyond 20: catalogues write 99 for what is not known.
//! Throws Error with file and line for text where a number should be, quotes that are not closed, places off the sphere, and magnitudes beyond -30 to 60.
StarCatalogue read_star_table(const std::filesystem::path& path);

//! The same from a stream; `file` goes into errors.
StarCatalogue parse_star_table(std::istream& stream, const std::string& file);

}  // namespace ergodome
