#pragma once

#include <cstdint>
#include <istream>

namespace ergodome {

//! Returns the minimum size [bytes] of a complete sound file according to its header: for WAV,
//! Wave64, AIFF and AU from the size of their samples, for MP3 from its Xing header. Returns 0 if
//! the header does not state it: other formats, files written to a pipe, and MP3 without that
//! header. The library plays such files as far as they exist. Source: Multimedia Programming
//! Interface and Data Specifications 1.0 (RIFF); EBU Tech 3306 (RF64); Audio Interchange File
//! Format 1.3; Sonic Foundry, Sony Wave64; Sun, au(4); id3.org, ID3v2.4.0 structure.
std::uint64_t promised_bytes(std::istream& file);

//! Returns whether an Ogg file consists of several streams in sequence (RFC 3533, 4); libsndfile
//! plays only the first.
bool is_chained_ogg(std::istream& file);

}  // namespace ergodome
