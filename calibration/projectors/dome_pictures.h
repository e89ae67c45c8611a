#pragma once

#include <optional>
#include <vector>

#include "calibration/projectors/dome_blend.h"
#include "calibration/projectors/projector_files.h"
#include "calibration/projectors/projector_picture.h"

namespace ergodome {

//! Returns a setup without the names of files that only contain what lenses and poses of the
//! projectors determine, because these can be recomputed after a change of the dome. They are warps
//! of domemasters (with a mask beside them) whose nodes agree with where the light meets the dome,
//! and masks of these projectors that the default BlendSettings produce. Files that differ, such as
//! external calibrations or manually moved corners, keep their names. `loaded` contains the result
//! of load_projector() for each projector.
DomeSetup without_computed_files(const DomeSetup& setup, const std::vector<LoadedProjector>& loaded);

//! The warps and masks of a dome's projectors while its setup is adjusted. Those that are computed
//! from lenses and poses, or stored in files but equal to computed ones (without_computed_files()),
//! follow the dome's tilt; those of other files do not change.
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

  //! Returns true if the tilt differs from that for which a warp file of the setup was made. Then
  //! only test patterns follow the new tilt, not the warp.
  [[nodiscard]] bool leaves_behind(const DomeSetup& setup) const;

  //! Returns for each projector whether its files no longer match its lens and pose.
  [[nodiscard]] std::vector<bool> outdated(const DomeSetup& setup) const;

  //! Returns a setup of this dome without the names of such files.
  [[nodiscard]] DomeSetup without_outdated(const DomeSetup& setup) const;

 private:
  [[nodiscard]] bool has_computed_mask(std::size_t projector) const;
  std::vector<BlendMap> masks_at_tilt(const DomeSetup& setup) const;

  DomeSetup read_;
  DomeSetup without_;                   //!< without computed files
  std::vector<LoadedProjector> files_;  //!< files of without_
  std::vector<ProjectorPicture> pictures_;
  double tilt_deg_;  //!< tilt that is shown
  double rotation_deg_;
  std::vector<BlendMap> masks_;     //!< as read
  std::optional<DomeBlend> blend_;  //!< blend of these masks; absent if none is computed
  std::vector<bool> coarse_;        //!< projectors whose masks are previews
};

}  // namespace ergodome
