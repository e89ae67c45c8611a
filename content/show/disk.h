#pragma once

#include <optional>

namespace ergodome {

//! How hot a disk is from its inner to its outer edge: as accretion makes it (Page & Thorne 1974), or the same everywhere.
enum class DiskProfile { page_thorne, uniform };

//! Clouds in a disk.
enum class DiskPattern { none, procedural };

//! A thin disk in the equatorial plane, whose matter runs along +φ on circular geodesics: a show's [disk].
struct DiskSettings {
  std::optional<double> inner;  //!< inner edge [M]; absent: the innermost stable orbit
  double outer = 20.0;          //!< outer edge [M]
  bool plunging = false;        //!< inside the innermost stable orbit matter falls; else nothing is there
  DiskProfile profile = DiskProfile::page_thorne;
  double temperature_k = 6000.0;  //!< where the disk is hottest
  bool limb_darkening = false;    //!< light leaves as from an atmosphere that scatters on electrons
  double opacity = 1.0;
  double exposure = 1.0;  //!< light of the disk where it is hottest, as it leaves, unshifted
  DiskPattern pattern = DiskPattern::none;
  double contrast = 0.6;  //!< of the pattern: logarithm of its brightness
  double speed = 20.0;    //!< of the flow: M of the hole's time in a second of the show

  bool operator==(const DiskSettings&) const = default;
};

}  // namespace ergodome
