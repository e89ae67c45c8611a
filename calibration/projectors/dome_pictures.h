#pragma once

#include <optional>
#include <vector>

#include "calibration/projectors/dome_blend.h"
#include "calibration/projectors/projector_files.h"
#include "calibration/projectors/projector_picture.h"

namespace ergodome {

//! Returns a setup without the names of those warp and mask files whose contents are determined by
//! the lenses and poses of the projectors. Such files can be recomputed after a change of the dome.
//!
//! Such a warp file is a warp of a domemaster whose nodes agree with the points where the
//! projector's light meets the dome. It counts only if the setup also names a blend mask, and no
//! black level comes from the warp's file. Such a mask file is a blend mask beside such a warp, as
//! the default BlendSettings produce it. The names of all other files, such as external
//! calibrations or warps with manually moved corners, are kept; also those of all files if a
//! projector has no lens.
//!
//! `loaded` contains the result of load_projector() for each projector.
DomeSetup without_computed_files(const DomeSetup& setup, const std::vector<LoadedProjector>& loaded);

//! The warps and masks of a dome's projectors while its setup is adjusted. Warps and masks that are
//! computed from lenses and poses, or come from files with the same contents as computed ones
//! (without_computed_files()), follow the dome's tilt. Those from other files do not change.
class DomePictures {
 public:
  //! Reads the files of a setup. With `preview`, computed masks are coarse until refine_mask()
  //! replaces them. Throws Error as projector_pictures() does.
  explicit DomePictures(DomeSetup setup, MaskDetail detail = MaskDetail::full);

  [[nodiscard]] const std::vector<ProjectorPicture>& pictures() const { return pictures_; }

  //! Applies tilt, rotation, offsets and colors of the same dome. For three projectors of 1920 x
  //! 1080 on two cores this takes about 50 ms, or 90 ms with the masks, which a new tilt requires.
  //! Returns true if masks changed. Throws Error, and changes nothing, if a projector would light
  //! no part of the dome.
  bool follow(const DomeSetup& setup, const std::vector<GridOffsets>& offsets);

  //! Computes one of the coarse masks at the raster's resolution and returns the index of its
  //! projector, or nothing if none is coarse.
  std::optional<std::size_t> refine_mask();

  //! Returns true if the tilt differs from that of the setup that was read, and a projector has a
  //! warp of the domemaster from a file that does not count as computed. Then only test patterns
  //! follow the new tilt, not the warp.
  [[nodiscard]] bool leaves_behind(const DomeSetup& setup) const;

  //! Returns for each projector whether its warp file counts as computed (without_computed_files())
  //! and the tilt of `setup` differs from the one for which it was made.
  [[nodiscard]] std::vector<bool> outdated(const DomeSetup& setup) const;

  //! Returns a setup of this dome without the names of outdated files.
  [[nodiscard]] DomeSetup without_outdated(const DomeSetup& setup) const;

 private:
  [[nodiscard]] bool has_computed_mask(std::size_t projector) const;
  std::vector<BlendMap> masks_at_tilt(const DomeSetup& setup) const;

  DomeSetup read_;
  //! The setup that was read, without the names of computed files.
  DomeSetup without_;
  std::vector<LoadedProjector> files_;  //!< files of without_
  std::vector<ProjectorPicture> pictures_;
  double tilt_deg_;  //!< current tilt, which follow() set
  double rotation_deg_;
  //! Computed masks for the tilt of the setup that was read; width 0 if not computed.
  std::vector<BlendMap> masks_;
  //! Edge blend from which masks_ were computed; absent if no mask was.
  std::optional<DomeBlend> blend_;
  std::vector<bool> coarse_;  //!< for each projector, whether its mask is still a preview
};

}  // namespace ergodome
