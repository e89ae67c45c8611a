#pragma once

#include <memory>
#include <optional>

#include "content/camera/hole_clock.h"
#include "content/show/show.h"
#include "kernels/disk/disk_appearance.h"
#include "render/backend/buffer.h"
#include "render/passes/stars/drawing/blackbody_colours.h"

namespace ergodome {

//! The disk of a show, in the form that kernels read.
class DiskPass {
 public:
  //! The show must have a disk.
  DiskPass(const Show& show, Backend backend);

  //! Applies the hole and the disk of a show. Recomputes only what has changed.
  void set_numbers(const Show& show);

  //! Returns whether the disk is visible. An animation may move one edge beyond the other or make
  //! the disk transparent.
  [[nodiscard]] bool is_visible() const;

  //! Returns the disk for kernels at a show time. `clock_lead`: Boyer-Lindquist time minus the
  //! show's time for a camera that falls through the horizon [M]; see CameraPose.
  [[nodiscard]] DiskAppearance look_at(double time_s, double clock_lead = 0.0) const;

  //! Number of entries in the temperature table.
  static constexpr int profile_count = 1024;
  static constexpr long profile_bytes = profile_count * static_cast<long>(sizeof(float));

 private:
  void make_profile();

  Spacetime spacetime_;
  std::optional<DiskSettings> disk_;
  HoleClock clock_{Spacetime{}, nullptr, 0.0};
  std::shared_ptr<const FreeFall> orbit_;  //!< orbit of the fall for which `clock_` was created
  BlackbodyColours colours_;
  Buffer<float> profile_;
  DiskAppearance appearance_{};
};

//! Returns the inner edge of a disk [M]: the configured one, but at least the innermost stable
//! circular orbit, or the horizon if the disk's matter plunges (DiskSettings::plunging).
double inner_edge(const DiskSettings& disk, Spacetime spacetime);

//! Returns the temperature of a disk at radius r [K] in the rest frame of its matter; 0 where it
//! emits no light.
double disk_temperature(const DiskSettings& disk, Spacetime spacetime, double r);

//! Returns the state of the cloud pattern's clock for a camera at the hole's time [M] (HoleClock).
//! Each ray shows the pattern earlier, by the light's travel time; see PatternTime.
PatternTime pattern_time(const DiskSettings& disk, Spacetime spacetime, double hole_time);

}  // namespace ergodome
