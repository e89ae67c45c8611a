#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/render/frame_request.h"
#include "content/show/show.h"

namespace ergodome {

//! The light of one frame, as automatic exposure measures it.
struct FrameLight {
  int frame = 0;        //!< counted from 0
  std::string request;  //!< fingerprint of the frame's request
  double light = 0.0;   //!< mean light (LightMeter::middle_light)
};

//! Writes the light of adjacent frames, at least one, to a file of its own in a folder, which is
//! created. Throws Error if that fails.
void write_light(const std::filesystem::path& folder, const std::vector<FrameLight>& frames);

//! Automatic exposure that is computed from the light of all frames, which other processes have
//! measured. Frames rendered in any order thus get the exposure of a film rendered in one run.
class FollowedLight {
 public:
  //! Reads the files of write_light() in a folder, and ignores light of frames with other
  //! fingerprints. Follows the light from the first frame that was measured to the last one without
  //! a gap. Throws Error if the folder cannot be read or a file is malformed.
  FollowedLight(const std::filesystem::path& folder, Show show, const FrameRequests& requests);

  //! Returns the stops of a frame, counted from 0; nothing before the first measured frame and
  //! after the last one.
  [[nodiscard]] std::optional<double> stops_at(int frame) const;

 private:
  int first_ = 0;
  std::vector<double> stops_;
};

}  // namespace ergodome
