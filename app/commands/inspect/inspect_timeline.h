#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "content/show/show.h"

namespace ergodome {

//! Returns a summary of the files that a show names and of its timeline: animated numbers,
//! chapters, captions, overlays and audio tracks, their languages, and whether their files exist.
//! `unusable` has the reasons why files cannot be used, by their keys.
nlohmann::json summary_of_timeline(const Show& show, const std::map<std::string, std::string>& unusable);

//! Of the files in a summary of summary_of_timeline(): `faulty`, the number of files that are
//! missing or cannot be used, and `all`, the number of all files.
struct FaultyFiles {
  int faulty = 0;
  int all = 0;
};
FaultyFiles faulty_files(const nlohmann::json& summary);

//! Prints the summary that summary_of_timeline() returns; nothing if it is empty.
void print_timeline(const nlohmann::json& summary);

}  // namespace ergodome
