#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "content/show/show.h"

namespace ergodome {

//! The files that a show names, and what it does with time: numbers that change, chapters, captions, overlays and audio tracks, in which languages, and whether the
//! files that they name are there and of use: `unusable` says why some are not, by their keys.
nlohmann::json facts_of_timeline(const Show& show, const std::map<std::string, std::string>& unusable);

//! How many of the files in such facts are not there or cannot be used, and of how many.
struct FaultyFiles {
  int faulty = 0;
  int all = 0;
};
FaultyFiles faulty_files(const nlohmann::json& facts);

//! Prints those facts; nothing for a show that has none.
void print_timeline(const nlohmann::json& facts);

}  // namespace ergodome
