#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "app/commands/movie/film_file.h"

namespace ergodome {

//! Title for the video track of a Matroska file, which reserves bytes for add_to_video().
std::string reserving_title();

//! Returns an element (RFC 8794) of up to 126 bytes of content; `id` is a number of up to four
//! bytes.
std::string matroska_element(std::uint32_t id, std::string_view content);

//! Adds elements of up to 50 bytes together to the settings of the first video track (element
//! Video, RFC 9559). Removes the track's title, whose bytes they take, so that nothing else in the
//! file moves. Throws Error if the title is missing, or if the file is malformed or has checksums
//! in its list of tracks.
void add_to_video(FilmFile& film, std::string_view elements);

}  // namespace ergodome
