#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "content/show/show.h"

namespace ergodome {

//! Returns a summary of the files that a show names and of its timeline: animated numbers,
//! chapters, captions, overlays and audio tracks, their languages, and whether their files exist.
//! `unusable` has the reasons why files cannot be used, by their keys.
nlohmann::json facts_of_timeline(const Show& show, const std::map<std::string, std::string>& unusable);

//! The number of files in such a summary that are missing or cannot be used, and of all.
struct FaultyFiles {
  int faulty = 0;
  int all = 0;
};
FaultyFiles faulty_files(const nlohmann::json& facts);

//! Prints that summary; nothing if the show has none.
void print_timeline(const nlohmann::json& facts);

}  // namespace ergodome
