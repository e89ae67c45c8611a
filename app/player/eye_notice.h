#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>

#include "content/show/show.h"
#include "render/eyes/narrowed_eyes.h"

namespace ergodome {

//! Tells that eyes stand closer than was asked: once of a show, and once more of each distance and model that a person has chosen since.
class EyeNotice {
 public:
  //! Of another show from now on.
  void begin() { told_.clear(); }

  //! Whether the eyes of a picture are to be told of. `chosen`: a person's distance in place of the show's [M].
  bool tells(const std::optional<NarrowedEyes>& eyes, const std::optional<double>& chosen) {
    return eyes && told_.emplace(eyes->model, chosen).second;
  }

 private:
  std::set<std::pair<StereoModel, std::optional<double>>> told_;
};

//! A line about it for the screen, in a language (tag).
std::string line_of(const NarrowedEyes& eyes, const std::string& language);

//! A sentence about it for the log, with the show's line where the distance is the show's own. `time_s`: of the show.
std::string note_of(const Show& show, double time_s, const NarrowedEyes& eyes, const std::optional<double>& chosen);

}  // namespace ergodome
