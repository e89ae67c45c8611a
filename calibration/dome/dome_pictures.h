#pragma once

#include <optional>
#include <vector>

#include "calibration/dome/dome_blend.h"
#include "calibration/projectors/projector_picture.h"

namespace ergodome {

//! The pictures of a dome's projectors while its setup is adjusted. Warps and masks that come from lenses and places, or that files hold and
//! lenses and places make as well (without_computed_files()), follow the dome's tilt; those of other files stay.
class DomePictures {
 public:
  //! Reads the files of a setup. With `preview`, computed masks are coarse until refine_mask() has replaced them. Throws Error for what
  //! projector_pictures() refuses.
  explicit DomePictures(DomeSetup setup, MaskDetail detail = MaskDetail::full);

  [[nodiscard]] const std::vector<ProjectorPicture>& pictures() const { return pictures_; }

  //! Takes over tilt, rotation, offsets and colours of the same dome; for three projectors of 1920 x 1080 on two cores in some 50 ms, and
  //! with masks, which a new tilt calls for, 90. True where there are new masks. Throws Error, and leaves all as it was,
  //! where a projector would light no part of the dome.
  bool follow(const DomeSetup& setup, const std::vector<GridOffsets>& offsets);

  //! Computes one of the coarse masks at the raster's resolution and returns the number of its projector, or nothing if none is coarse.
  std::optional<std::size_t> refine_mask();

  //! Whether a setup of this dome has another tilt than one of its files was made for: that file stays as it is, and patterns alone follow.
  [[nodiscard]] bool leaves_behind(const DomeSetup& setup) const;

  //! Which projectors have files that no longer hold what their lenses and places make.
  [[nodiscard]] std::vector<bool> outdated(const DomeSetup& setup) const;

  //! A setup of this dome without the names of such files.
  [[nodiscard]] DomeSetup without_outdated(const DomeSetup& setup) const;

 private:
  [[nodiscard]] bool has_computed_mask(std::size_t projector) const;
  std::vector<BlendMap> masks_at_tilt(const DomeSetup& setup) const;

  DomeSetup read_;
  DomeSetup without_;                   //!< without computed files
  std::vector<LoadedProjector> files_;  //!< those of without_
  std::vector<ProjectorPicture> pictures_;
  double tilt_deg_;  //!< that is shown
  double rotation_deg_;
  std::vector<BlendMap> masks_;     //!< as they were read
  std::optional<DomeBlend> blend_;  //!< of these; none where no mask is computed
  std::vector<bool> coarse_;        //!< projectors whose masks are previews
};

}  // namespace ergodome
