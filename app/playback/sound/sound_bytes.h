#pragma once

#include <cstdint>
#include <istream>

namespace ergodome {

//! The length [bytes] that a sound file has at the least if all is there that its header promises: of WAV, Wave64, AIFF and AU by the size of their samples, of
//! MP3 by its Xing header. 0 where a header tells nothing: other kinds, what was written to a pipe, and MP3 without that header. The library takes such
//! files for as long as they are, and plays what there is.
//! Source: Multimedia Programming Interface and Data Specifications 1.0 (RIFF); EBU Tech 3306 (RF64); Audio Interchange File Format 1.3; Sonic Foundry, Sony Wave64; Sun, au(4); id3.org, ID3v2.4.0 structure.
std::uint64_t promised_bytes(std::istream& file);

//! True if an Ogg file is several streams one after the other (RFC 3533, 4), of which libsndfile plays the first alone.
bool is_chained_ogg(std::istream& file);

}  // namespace ergodome
