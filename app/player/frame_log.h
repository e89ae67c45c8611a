#pragma once

#include <fstream>
#include <string>

#include "app/cluster/cluster_messages.h"
#include "render/picture/picture.h"

namespace ergodome {

//! A file with a line for each frame that a computer of a cluster has shown: number, show time, pose,
//! settings, a fingerprint of the picture and the factor on its light. Equal lines of two computers
//! up to there mean equal pictures. Then follow the time of day, and what only one kind has: a
//! fingerprint of the projectors' images (node), and the time for which a finished picture waited
//! for the nodes (master).
class FrameLog {
 public:
  //! Throws Error if the file cannot be written. Empty: no log.
  explicit FrameLog(const std::string& file);

  //! Adds a frame when it is shown. Pictures in GPU memory have no fingerprint.
  void add(const ClusterFrame& frame, const Picture& picture, const std::string& images, double waited_ms = 0.0);

  [[nodiscard]] bool wanted() const { return file_.is_open(); }

 private:
  std::ofstream file_;
};

}  // namespace ergodome
