#pragma once

#include <memory>
#include <optional>

#include "content/show/show.h"
#include "content/timeline/hole_clock.h"
#include "kernels/disk/disk_look.h"
#include "render/backend/buffer.h"
#include "render/passes/stars/drawing/blackbody_colours.h"

namespace ergodome {

//! A show's disk in the form that kernels read.
class DiskPass {
 public:
  //! The show must have a disk.
  DiskPass(const Show& show, Backend backend);

  //! Takes the hole and the disk of a show; what has not changed costs nothing.
  void set_numbers(const Show& show);

  //! Whether there is anything to see: an edge that the show has moved past the other leaves nothing.
  [[nodiscard]] bool is_visible() const;

  //! The disk as kernels read it, at a show time; `clock_lead` [M] as CameraPose has it.
  [[nodiscard]] DiskLook look_at(double time_s, double clock_lead = 0.0) const;

  //! Temperatures in the table.
  static constexpr int profile_count = 1024;
  static constexpr long profile_bytes = profile_count * static_cast<long>(sizeof(float));

 private:
  void make_profile();

  double spin_ = 0.0;
  std::optional<DiskSettings> disk_;
  HoleClock clock_{0.0, nullptr, 0.0};
  std::shared_ptr<const FreeFall> orbit_;  //!< the clock's
  BlackbodyColours colours_;
  Buffer<float> profile_;
  DiskLook look_{};
};

//! The inner edge of a disk [M]: where it begins by its own number, and by where matter can be.
double inner_edge(const DiskSettings& disk, double spin);

//! The temperature of a disk at radius r [K], as its own matter measures it; 0 where it does not shine.
double disk_temperature(const DiskSettings& disk, double spin, double r);

//! Clouds at the hole's time [M] (HoleClock), as late as light is behind it: see PatternTime.
PatternTime pattern_time(const DiskSettings& disk, double spin, double hole_time);

}  // namespace ergodome
