#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "kernels/projection/projection.h"
#include "render/channels/channel_names.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! How exactly the rays of channels are followed: as closely as doubles allow.
inline constexpr double channel_tolerance = 1e-14;
inline constexpr int channel_step_limit = 100'000;

//! A number at each pixel, row by row from the top. NaN where it is undefined.
struct PixelChannel {
  ChannelMeaning meaning;
  std::vector<double> values;
};

//! What the rays of a picture may meet.
struct ChannelScene {
  EyeCamera eye;
  Projection projection;
  double disk_inner = 0.0;  //!< edges of the disk [M]; for the groups of the disk alone
  double disk_outer = 0.0;
  glm::dmat3 equatorial_from_sky{1.0};  //!< from the hole's sky axes to J2000
};

//! The channels of some groups, in their order.
struct PixelChannels {
  std::vector<PixelChannel> channels;
  long unresolved = 0;  //!< pixels with a ray that did not converge: its numbers are NaN
};

//! Computes the numbers of every pixel from the ray through its middle, in double precision on the CPU. Pixels whose middle lies outside
//! the image are NaN. ChannelGroup::color is not among `groups`.
//!
//! `advance` is called now and then; channels are incomplete, and of no use, once it has returned false.
PixelChannels trace_channels(const ChannelScene& scene, const std::vector<ChannelGroup>& groups,
                             const std::function<bool()>& advance);

}  // namespace ergodome
