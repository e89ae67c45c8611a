#pragma once

#include <optional>

namespace ergodome {

//! Temperature of a disk from its inner to its outer edge: that of an accretion disk (Page & Thorne
//! 1974), or uniform.
enum class DiskProfile { page_thorne, uniform };

//! Brightness pattern of a disk; `procedural` draws clouds.
enum class DiskPattern { none, procedural };

//! A thin disk in the equatorial plane, whose matter moves toward +φ on circular geodesics: a
//! show's [disk].
struct DiskSettings {
  std::optional<double> inner;  //!< inner edge [M]; absent: the innermost stable circular orbit
  double outer = 20.0;          //!< outer edge [M]
  bool plunging = false;        //!< matter plunges inside the innermost stable orbit; otherwise the disk ends there
  DiskProfile profile = DiskProfile::page_thorne;
  double temperature_k = 6000.0;  //!< temperature at the hottest radius
  bool limb_darkening = false;    //!< light leaves as from an electron-scattering atmosphere
  double opacity = 1.0;
  double exposure = 1.0;  //!< emitted light at the hottest radius, without redshift
  DiskPattern pattern = DiskPattern::none;
  double contrast = 0.6;  //!< strength of the pattern: factor on the logarithm of its brightness
  //! Rate at which the disk's time advances [M of the hole's time per second of the show].
  double speed = 20.0;

  bool operator==(const DiskSettings&) const = default;
};

}  // namespace ergodome
