#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/commands/render/render_options.h"
#include "calibration/dome/dome_setup.h"
#include "content/show/show.h"

namespace ergodome {

//! Fingerprints of all that a run's frames are made by, which each of them carries: the show, the setup and the options as they were asked for, what the
//! files that they name hold, and the program's version. Where it is computed, and where frames are put, makes no difference; nor does what no picture shows
//! (sound, chapters, the show's length where nothing hangs on it), or not that frame: captions that are not seen at its time, or in its language.
class FrameRequests {
 public:
  FrameRequests(const RenderOptions& options, const Show& show, const std::optional<DomeSetup>& setup);

  //! Of the frame at a time of the show [s].
  [[nodiscard]] std::string at(double time_s) const;

 private:
  std::string of_all_;  //!< of what all frames are made by
  std::vector<Caption> captions_;
  std::string language_;
};

}  // namespace ergodome
