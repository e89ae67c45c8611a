#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/commands/render/render_options.h"
#include "calibration/dome/dome_setup.h"
#include "content/show/show.h"

namespace ergodome {

//! Computes fingerprints of everything that a run's frames depend on; each frame stores its own.
//! They cover the show, the setup and the options, the contents of the files that these name, and
//! the program's version. They do not depend on the backend or the output folder, nor on things
//! that a frame does not show: sound, chapters, the show's length unless it matters, and captions
//! invisible at its time or in its language.
class FrameRequests {
 public:
  FrameRequests(const RenderOptions& options, const Show& show, const std::optional<DomeSetup>& setup);

  //! Returns the fingerprint of the frame at a show time [s].
  [[nodiscard]] std::string at(double time_s) const;

 private:
  std::string of_all_;  //!< fingerprint of what all frames share
  std::vector<Caption> captions_;
  std::string language_;
};

}  // namespace ergodome
