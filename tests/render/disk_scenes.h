#pragma once

#include "content/show/show.h"

// Shows with a disk, for tests.
namespace ergodome::test {

//! Returns a show with a hole, a disk and redshift. Its camera has no keys.
inline Show show_with(double spin, const DiskSettings& disk) {
  Show show;
  show.spin = spin;
  show.disk = disk;
  show.effects.redshift = true;
  return show;
}

//! Returns a disk with uniform light between two radii [M].
inline DiskSettings uniform_disk(double inner, double outer) {
  DiskSettings disk;
  disk.inner = inner;
  disk.outer = outer;
  disk.profile = DiskProfile::uniform;
  return disk;
}

}  // namespace ergodome::test
