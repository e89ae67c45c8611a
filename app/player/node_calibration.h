#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/cluster/cluster_messages.h"
#include "calibration/projectors/dome_pictures.h"
#include "render/picture/picture.h"

namespace ergodome {

//! The projectors of a node while the master's operator calibrates the dome.
class NodeCalibration {
 public:
  //! `setup`: with the projectors of all computers.
  NodeCalibration(DomeSetup setup, std::string node);

  //! Follows the calibration of a frame; returns to the setup that was read if it has none. Returns
  //! whether pictures() changed. Throws Error, and keeps the pictures, if a setup is invalid or a
  //! projector would light no part of the dome.
  bool follow(const ClusterFrame& frame, const std::optional<ClusterCalibration>& calibration);

  //! Returns the pictures of this node's projectors, after follow() has returned true.
  [[nodiscard]] std::vector<ProjectorPicture> pictures() const;
  //! Returns the texts to show on this node's projectors.
  [[nodiscard]] const std::vector<std::string>& texts() const { return texts_; }

  //! Returns whether a frame shows other rasters than the last one for which this was called.
  [[nodiscard]] bool rasters_change(const ClusterFrame& frame);
  //! Returns the raster of each of this node's projectors; nothing if they show the frame.
  [[nodiscard]] std::vector<Picture> rasters(const ClusterFrame& frame) const;

  //! Returns a function that draws the test pattern of a frame as a domemaster of a width [px]; an
  //! empty function if the frame has none.
  [[nodiscard]] std::function<Picture(int)> pattern_of(const ClusterFrame& frame) const;

 private:
  DomeSetup read_;
  DomeSetup setup_;               //!< as calibrated
  std::vector<std::size_t> own_;  //!< indices of this node's projectors
  std::optional<DomePictures> pictures_;
  std::string text_;  //!< setup that `pictures_` follow
  std::vector<GridOffsets> offsets_;
  std::vector<std::string> texts_;
  std::uint32_t version_ = 0;
  bool numbers_ = false;
};

}  // namespace ergodome
