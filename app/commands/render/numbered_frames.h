#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace ergodome {

//! Numbers, from 0 and in order, of the frames of a name that lie in a folder, or in its folders for ten thousand each. `path_of` says where a frame's file
//! belongs: what is elsewhere, or called otherwise, is none.
std::vector<int> numbered_frames(const std::filesystem::path& folder, const std::string& name,
                                 const std::function<std::filesystem::path(int)>& path_of);

//! Frames, counted from 0 and in order, as a person reads them, counted from 1: "4:6, 9". Of many ranges the first are told.
std::string frame_ranges(const std::vector<int>& frames);

}  // namespace ergodome
