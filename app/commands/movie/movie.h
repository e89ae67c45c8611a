#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/movie/movie_sound.h"
#include "app/commands/movie/spherical_metadata.h"

namespace ergodome {

//! A film made from numbered frames by ffmpeg, if that is installed.
struct Movie {
  std::filesystem::path file;  //!< .mp4, .mov or .mkv, which determines the codec
  double frame_rate_hz = 30.0;
  std::vector<std::filesystem::path> pictures;  //!< PNG or TIFF, in order
  const MovieSound* sound = nullptr;            //!< sound of the same length as the film; nullptr: silent
  //! Both the frames and the film have an alpha channel.
  bool alpha = false;
  //! How players for VR headsets show the film; absent for films that are flat or for domes.
  std::optional<SphericalFilm> sphere;
};

//! Returns whether films with this ending (movie_ending) support an alpha channel.
bool holds_alpha(const std::string& ending);

//! Returns the ending of a film's name in lower case: ".mp4", ".mov" or ".mkv". Throws Error for
//! other endings.
std::string movie_ending(const std::filesystem::path& file);

//! Throws Error unless a film of that name can be written and ffmpeg runs. Call it before
//! rendering.
void require_movie_encoder(const std::filesystem::path& file);

//! Returns ffmpeg's arguments for frames of this size; `partial` is its output file. Frames are
//! piped as raw 16-bit pixels, so that ffmpeg need not support their format.
//!
//! .mp4: H.264, or HEVC for frames wider than H.264 decoders accept, 4:2:0, nearly lossless. .mov:
//! ProRes 4444. .mkv: FFV1, lossless. The last two support alpha. Sound is read from sound_handle
//! (movie.cpp) and encoded as AAC in .mp4, otherwise as 24-bit PCM.
std::vector<std::string> movie_arguments(const Movie& movie, int width_px, int height_px,
                                         const std::filesystem::path& partial);

//! Encodes the frames, all of one size, with ffmpeg, and adds the metadata of `sphere`. Leaves
//! either a complete film or none. Throws Error with ffmpeg's last message or the disk error.
void write_movie(const Movie& movie);

//! Decodes a film completely with ffmpeg. Throws Error if that fails or is interrupted, or if the
//! number of frames differs from `pictures`.
void check_movie(const Movie& movie);

}  // namespace ergodome
