#pragma once

#include <filesystem>
#include <string>

#include "content/show/show.h"

namespace ergodome {

//! A stretch of a show's sound, mixed as `play` does it, but as fast as the machine can: two channels of floating point side by side, in a file without
//! a name, which is gone when this is.
class MovieSound {
 public:
  static constexpr int rate_hz = 48000;

  //! Mixes from a time of the show on [s], for as long as given [s]. `language`: whose narration is heard; empty: as `play` chooses it. `folder`: on whose
  //! disk the file is. Tracks that cannot be played are left out, and told on the terminal. Throws Error where the disk refuses.
  MovieSound(const Show& show, const std::string& language, double from_s, double length_s,
             const std::filesystem::path& folder);

  //! The file's handle, to be read from its start.
  [[nodiscard]] int rewound() const;

 private:
  //! Closes its file in the end.
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
