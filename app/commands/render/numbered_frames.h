#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace ergodome {

//! Returns the frame numbers, counted from 0 and sorted, of the files NAME_000001... in a folder
//! and in its subfolders of ten thousand frames (frame_path()). Ignores files whose path is not the
//! one that `path_of` gives for their number.
std::vector<int> numbered_frames(const std::filesystem::path& folder, const std::string& name,
                                 const std::function<std::filesystem::path(int)>& path_of);

//! Formats sorted frames, counted from 0, as ranges counted from 1: "4:6, 9". Lists at most eight
//! ranges.
std::string frame_ranges(const std::vector<int>& frames);

}  // namespace ergodome
