#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "kernels/projection/projection.h"
#include "render/channels/channel_names.h"
#include "render/eyes/eye_camera.h"

// Computes the channels of a picture in double precision.

namespace ergodome {

//! Tolerance of the ray integration: as small as doubles allow.
inline constexpr double channel_tolerance = 1e-14;
inline constexpr int channel_step_limit = 100'000;

//! The values of a channel, row by row from the top; NaN where undefined.
struct PixelChannel {
  ChannelMeaning meaning;
  std::vector<double> values;
};

//! The scene that the channels of a picture describe: camera, projection, hole and disk.
struct ChannelScene {
  EyeCamera eye;
  Projection projection;
  //! Inner edge of the disk [M]; the edges are used only by the groups of the disk.
  double disk_inner = 0.0;
  double disk_outer = 0.0;
  glm::dmat3 equatorial_from_sky{1.0};  //!< rotation from the hole's sky axes to equatorial J2000
};

//! The channels of some groups, in their order.
struct PixelChannels {
  std::vector<PixelChannel> channels;
  long unresolved = 0;  //!< pixels with a ray that did not converge; values from that ray are NaN
};

//! Computes the channel values of every pixel from the ray through the pixel's center, in double
//! precision on the CPU. Pixels whose center is outside the image are NaN. `groups` must not
//! contain ChannelGroup::color.
//!
//! `advance` is called before each block of 32768 pixels; if it returns false, tracing stops, and
//! the values of the remaining pixels are NaN.
PixelChannels trace_channels(const ChannelScene& scene, const std::vector<ChannelGroup>& groups,
                             const std::function<bool()>& advance);

}  // namespace ergodome
