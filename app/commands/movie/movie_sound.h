#pragma once

#include <filesystem>
#include <string>

#include "content/show/show.h"

namespace ergodome {

//! A section of a show's sound, mixed as `play` does, but as fast as possible: two interleaved
//! channels of float samples in an unnamed file, which is deleted with this object.
class MovieSound {
 public:
  static constexpr int rate_hz = 48000;

  //! Mixes the sound from a show time [s] for a duration [s]. `language` chooses the narration; if
  //! empty, it is chosen as `play` does. `folder` is on the disk that stores the file. Leaves out
  //! tracks that cannot be played, with a note. Throws Error if the disk is full or cannot be
  //! written.
  MovieSound(const Show& show, const std::string& language, double from_s, double length_s,
             const std::filesystem::path& folder);

  //! Returns the file descriptor, positioned at the start.
  [[nodiscard]] int rewound() const;

 private:
  //! An unnamed file that is closed by the destructor.
  struct NamelessFile {
    explicit NamelessFile(const std::filesystem::path& folder);
    ~NamelessFile();
    NamelessFile(const NamelessFile&) = delete;
    NamelessFile& operator=(const NamelessFile&) = delete;
    int handle;
  };
  NamelessFile file_;
};

}  // namespace ergodome
