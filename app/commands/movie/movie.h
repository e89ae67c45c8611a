#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/commands/movie/movie_sound.h"

namespace ergodome {

//! A film of numbered pictures, made by ffmpeg where that is installed.
struct Movie {
  std::filesystem::path file;  //!< .mp4, .mov or .mkv: what is in it follows from that
  double frame_rate_hz = 30.0;
  std::vector<std::filesystem::path> pictures;  //!< PNG or TIFF, in order
  const MovieSound* sound = nullptr;            //!< of the same length; nullptr: none
  bool alpha = false;  //!< the pictures have a channel of what they cover, and so shall the film
};

//! Whether films of an ending (movie_ending) can have a channel of what pictures cover.
bool holds_alpha(const std::string& ending);

//! The ending of a film's name in small letters: ".mp4", ".mov" or ".mkv". Throws Error where it is none of them.
std::string movie_ending(const std::filesystem::path& file);

//! Throws Error unless a film of that name can be written, and ffmpeg answers: asked before pictures are made.
void require_movie_encoder(const std::filesystem::path& file);

//! ffmpeg's arguments for pictures of a size; `partial` is the file that it writes. The pictures come to it as plain pixels of 16 bits, so that
//! it need not know their format.
//!
//! .mp4: H.264, or HEVC for pictures wider than H.264 decoders take, 4:2:0, near to without loss; .mov: ProRes 4444; .mkv: FFV1, lossless; both with coverage. Sound comes
//! to it as sound_handle, and is AAC in .mp4, else PCM of 24 bits.
std::vector<std::string> movie_arguments(const Movie& movie, int width_px, int height_px,
                                         const std::filesystem::path& partial);

//! Hands the pictures, all of one size, to ffmpeg, one after the other. The film is there whole or not at
//! all; Error says what ffmpeg said last, or what the disk did.
void write_movie(const Movie& movie);

//! Has ffmpeg decode a film from end to end. Throws Error if it cannot, or if the film has another number of frames than `pictures`.
void check_movie(const Movie& movie);

}  // namespace ergodome
