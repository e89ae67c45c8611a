#pragma once

#include <cstdint>
#include <string>

namespace ergodome {

//! What to tell where the rest of a run takes more bytes than the disk of its folder has left; empty where there is room.
std::string room_note(const std::string& folder, std::uintmax_t taken_bytes, std::uintmax_t left_bytes);

}  // namespace ergodome
