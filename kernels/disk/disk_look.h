#pragma once

#include "kernels/disk/disk_emitter.h"
#include "kernels/disk/disk_pattern.h"
#include "kernels/sky/blackbody.h"

namespace ergodome {

//! Temperature over radius, as kernels read it: T at equal steps of √(1 - r_0 / r), with which a disk's temperature rises
//! from 0 at its last stable orbit r_0.
struct DiskProfileTable {
  const float* temperature;  //!< [K]
  int count;
  float first_r;  //!< r_0 [M]
  float step;
};

//! What a disk looks like.
struct DiskLook {
  DiskFlow<float> flow;
  float inner_r;  //!< edges [M]
  float outer_r;
  DiskProfileTable profile;
  BlackbodyTable colours;
  float log_unit;  //!< ln of the luminance [cd/m²] that is shown as `exposure`
  float exposure;
  float opacity;
  bool shifted;        //!< frequencies are: light of a blackbody T is seen as that of one of g T
  bool limb_darkened;  //!< as an atmosphere that scatters on electrons
  float contrast;      //!< of the pattern; 0: none
  PatternTime pattern;
};

//! Whether azimuth and time are wanted: kernels have a variant without.
constexpr bool has_pattern(const DiskLook& look) { return look.contrast > 0.0F; }

}  // namespace ergodome
