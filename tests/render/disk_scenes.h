#pragma once

#include "content/show/show.h"

namespace ergodome::test {

//! A hole with a disk and redshift, before any camera.
inline Show show_with(double spin, const DiskSettings& disk) {
  Show show;
  show.spin = spin;
  show.disk = disk;
  show.effects.redshift = true;
  return show;
}

//! Of the same light everywhere between two radii [M].
inline DiskSettings uniform_disk(double inner, double outer) {
  DiskSettings disk;
  disk.inner = inner;
  disk.outer = outer;
  disk.profile = DiskProfile::uniform;
  return disk;
}

}  // namespace ergodome::test
