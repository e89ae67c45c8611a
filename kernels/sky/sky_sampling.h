#pragma once

#include <cstdint>

namespace ergodome {

//! How a pixel samples the sky map.
enum class SkyFilter : std::int32_t {
  ewa,     //!< over its elliptic footprint (kernels/sky/elliptic_filter.h)
  point,   //!< only at its center (kernels/sky/elliptic_filter.h)
  polygon  //!< over its outline on the map, like Verbraeck & Eisemann, for comparison
};

//! Effect of the frequency ratio on the light of the sky map.
enum class SkyShift : std::int32_t {
  none,
  luminance,     //!< brightness scales with g⁴; colors are unchanged
  blackbody_fit  //!< each texel is shifted like the blackbody nearest in color
};

}  // namespace ergodome
