#pragma once

#include <cstdint>

namespace ergodome {

//! How a pixel takes its light from the sky's map.
enum class SkyFilter : std::int32_t {
  ewa,     //!< over its elliptic footprint (kernels/sky/elliptic_filter.h)
  point,   //!< in its middle alone (kernels/sky/point_sample.h)
  polygon  //!< over its outline on the map, as Verbraeck & Eisemann do (render/sky/polygon_filter.h), for comparison
};

//! What the frequency ratio does to the light of the sky's map.
enum class SkyShift : std::int32_t {
  none,
  luminance,     //!< brightness goes with g⁴; colours stay
  blackbody_fit  //!< each texel shines as the blackbody does whose colour is nearest
};

}  // namespace ergodome
