#pragma once

#include <toml++/toml.h>

#include <string>

#include "content/show/show.h"

namespace ergodome {

//! Reads the table [disk] of a show file. Throws Error with file, line and key for invalid values.
DiskSettings read_disk(const toml::table& table, const std::string& file);

//! Throws Error if the disk's edges are out of order, or if its matter cannot exist there at some
//! time.
void check_disk(const toml::table& table, const std::string& file, const Show& show);

//! Returns a disk as a table that read_disk() accepts.
toml::table disk_table(const DiskSettings& disk);

}  // namespace ergodome
