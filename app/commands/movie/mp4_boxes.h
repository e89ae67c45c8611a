#pragma once

#include <string>
#include <string_view>

#include "app/commands/movie/film_file.h"

namespace ergodome {

//! Boxes for the video track of an MP4 or QuickTime file, as the bytes of mp4_box().
struct VideoTrackBoxes {
  std::string sample_entry;  //!< go into the sample entry, after the configuration of the codec
  std::string track;         //!< go to the end of the track
};

//! Returns a box: its size, its type of four characters, and its content.
std::string mp4_box(std::string_view type, std::string_view content);

//! Inserts boxes into the first video track (ISO/IEC 14496-12) and corrects the positions of the
//! samples. Throws Error if the file is malformed or its disk is full; the file is then unusable.
void insert_boxes(FilmFile& film, const VideoTrackBoxes& boxes);

}  // namespace ergodome
