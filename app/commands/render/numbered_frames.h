#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace ergodome {

//! Returns the numbers, from 0 and sorted, of the frames of a name in a folder or in its subfolders
//! of ten thousand frames each. Ignores files in other locations than `path_of` gives for their
//! number.
std::vector<int> numbered_frames(const std::filesystem::path& folder, const std::string& name,
                                 const std::function<std::filesystem::path(int)>& path_of);

//! Formats sorted frames, counted from 0, as ranges counted from 1: "4:6, 9". Lists at most eight
//! ranges.
std::string frame_ranges(const std::vector<int>& frames);

}  // namespace ergodome
