#pragma once

#include <toml++/toml.h>

#include <string>

#include "content/show/show.h"

namespace ergodome {

//! Reads the table [disk] of a show's file. Throws Error with file, line and key for what cannot be.
DiskSettings read_disk(const toml::table& table, const std::string& file);

//! Throws Error where the disk's edges are out of order, or nothing can be where the show puts it, at some time.
void check_disk(const toml::table& table, const std::string& file, const Show& show);

//! A disk as a table that read_disk reads back.
toml::table disk_table(const DiskSettings& disk);

}  // namespace ergodome
