#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>

#include "content/show/show.h"
#include "render/stereo/reduced_baseline.h"

namespace ergodome {

//! Decides when to report that the baseline was reduced: once per show, and again for each baseline
//! and stereo model that the operator has chosen since.
class EyeNotice {
 public:
  //! Forgets all reports at the start of another show.
  void begin() { reported_.clear(); }

  //! Returns whether to report the reduced baseline of a frame, and counts it as reported. `eyes`
  //! is absent if it was not reduced; `chosen` is the operator's baseline instead of the show's
  //! [M].
  bool is_news(const std::optional<ReducedBaseline>& eyes, const std::optional<double>& chosen) {
    return eyes && reported_.emplace(eyes->model, chosen).second;
  }

 private:
  std::set<std::pair<decltype(ReducedBaseline::model), std::optional<double>>> reported_;
};

//! Returns the notice for the screen, in German for "de", otherwise in English.
std::string line_of(const ReducedBaseline& eyes, const std::string& language);

//! Returns the sentence for the log, with the line of the show file if the baseline is the show's.
//! `time_s` is the show time.
std::string note_of(const Show& show, double time_s, const ReducedBaseline& eyes, const std::optional<double>& chosen);

}  // namespace ergodome
