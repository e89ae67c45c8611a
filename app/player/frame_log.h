#pragma once

#include <fstream>
#include <string>

#include "app/cluster/cluster_messages.h"
#include "render/picture/picture.h"

namespace ergodome {

//! A file with a line for each frame that a computer of a cluster has shown: number, show time, pose,
//! settings, and a fingerprint of the picture. Equal lines of two computers mean equal pictures.
class FrameLog {
 public:
  //! Throws Error if the file cannot be written. Empty: no log.
  explicit FrameLog(const std::string& file);

  //! Adds a frame when it is shown. Pictures in GPU memory have no fingerprint.
  void add(const ClusterFrame& frame, const Picture& picture);

  [[nodiscard]] bool wanted() const { return file_.is_open(); }

 private:
  std::ofstream file_;
};

}  // namespace ergodome
