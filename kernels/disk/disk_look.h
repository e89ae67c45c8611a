#pragma once

#include "kernels/disk/disk_emitter.h"
#include "kernels/disk/disk_pattern.h"
#include "kernels/sky/blackbody.h"

// A disk's appearance as kernels read it: edges, temperature, exposure and pattern.
namespace ergodome {

//! Temperature as a function of radius, as kernels read it: T at equal steps of √(1 - r_0 / r),
//! with which a disk's temperature rises from 0 at its innermost stable orbit r_0.
struct DiskProfileTable {
  const float* temperature;  //!< [K]
  int count;
  float first_r;  //!< r_0 [M]
  float step;
};

//! How a disk looks.
struct DiskLook {
  DiskFlow<float> flow;
  float inner_r;  //!< edges [M]
  float outer_r;
  DiskProfileTable profile;
  BlackbodyTable colours;
  float log_unit;  //!< ln of the luminance [cd/m²] that is shown as `exposure`
  float exposure;
  float opacity;
  //! Frequencies are shifted: light of a blackbody T is seen as that of one of g T.
  bool shifted;
  bool limb_darkened;  //!< as by an atmosphere that scatters on electrons
  float contrast;      //!< of the pattern; 0: no pattern
  PatternTime pattern;
};

//! Returns whether azimuth and time are needed; kernels have a variant without them.
constexpr bool has_pattern(const DiskLook& look) { return look.contrast > 0.0F; }

}  // namespace ergodome
