#include "app/player/renderers/picture_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ergodome {

namespace {

constexpr int view_light_px = 96;
//! Linear light above which a pixel counts as lit: half of the first step of an 8-bit sRGB display.
constexpr float darkest_lit = 0.5F / 255.0F / 12.92F;

}  // namespace

double lit_part(const Picture& picture, const Tone& tone) {
  long lit = 0;
  for (std::size_t i = 0; i + 3 < picture.rgba.size(); i += 4) {
    const float light = std::max({picture.rgba[i], picture.rgba[i + 1], picture.rgba[i + 2]});
    lit += toned(tone, light) > darkest_lit ? 1 : 0;
  }
  const double pixels = static_cast<double>(picture.width) * picture.height;
  return pixels > 0.0 ? static_cast<double>(lit) / pixels : 0.0;
}

double lit_part_of_view(ShowRenderer& renderer, const PictureRequest& request, const ShowMoment& moment) {
  const PlayerFrame& frame = request.frame;
  // A view is not black because an operator darkened the display.
  Tone tone = renderer.tone();
  tone.gain *= static_cast<float>(std::exp2(-frame.exposure_stops));
  const Projection projection = make_projection(renderer.show().view, view_light_px, frame.field_of_view_deg);
  return lit_part(renderer.render_eye(frame.pose, 0.0, projection, frame.mode, moment), tone);
}

}  // namespace ergodome
