#include "render/output/stereo_layout.h"

#include <algorithm>

#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

constexpr std::size_t channels = 4;

//! Fraction of the other colors that remains in a tinted picture.
constexpr float tint = 0.35F;

//! Returns a picture of another size, without pixels, with the same name of the lens, heat range
//! and tone.
Picture frame_like(const Picture& picture, ImageSize size) {
  Picture made;
  made.width = size.width;
  made.height = size.height;
  made.lens = picture.lens;
  made.heat_range = picture.heat_range;
  made.tone = picture.tone;
  return made;
}

std::size_t numbers_of(const Picture& picture) {
  return channels * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
}

//! Returns a black picture of another size, with the same name of the lens, heat range and tone.
Picture like(const Picture& picture, ImageSize size) {
  Picture made = frame_like(picture, size);
  made.rgba.assign(numbers_of(made), 0.0F);
  return made;
}

std::size_t position(const Picture& picture, int x, int y) {
  return channels *
         (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
}

//! Averages neighboring pixels: `across` = 2 halves the width, `down` = 2 the height.
Picture squeezed(const Picture& picture, int across, int down) {
  Picture half = like(picture, {(picture.width + across - 1) / across, (picture.height + down - 1) / down});
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      const std::size_t first = position(picture, across * x, down * y);
      const std::size_t second = position(picture, std::min(across * (x + 1), picture.width) - 1,
                                          std::min(down * (y + 1), picture.height) - 1);
      for (std::size_t c = 0; c < channels; ++c) {
        half.rgba[position(half, x, y) + c] = 0.5F * (picture.rgba[first + c] + picture.rgba[second + c]);
      }
    }
  }
  return half;
}

//! Copies an eye's picture to a position in a larger one.
void copy_to(Picture& whole, const Picture& eye, int left_px, int top_px) {
  parallel_for(eye.height, 64, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      std::copy_n(eye.rgba.data() + position(eye, 0, y), channels * static_cast<std::size_t>(eye.width),
                  whole.rgba.data() + position(whole, left_px, top_px + y));
    }
  });
}

Picture beside(const Picture& left, const Picture& right) {
  Picture whole = frame_like(left, {2 * left.width, left.height});
  whole.rgba.resize(numbers_of(whole));
  copy_to(whole, left, 0, 0);
  copy_to(whole, right, left.width, 0);
  return whole;
}

Picture above(const Picture& left, const Picture& right) {
  Picture whole = frame_like(left, {left.width, 2 * left.height});
  whole.rgba.resize(numbers_of(whole));
  copy_to(whole, left, 0, 0);
  copy_to(whole, right, 0, left.height);
  return whole;
}

Picture interleaved(const Picture& left, const Picture& right) {
  Picture whole = left;
  for (int y = 1; y < whole.height; y += 2) {
    std::copy_n(right.rgba.begin() + static_cast<long>(position(right, 0, y)),
                channels * static_cast<std::size_t>(right.width),
                whole.rgba.begin() + static_cast<long>(position(whole, 0, y)));
  }
  return whole;
}

//! Contributions of an eye's red, green and blue to the red, green and blue of an anaglyph.
struct AnaglyphMix {
  float of_left[3][3];
  float of_right[3][3];
};

constexpr AnaglyphMix half_colour = {{{0.2126F, 0.7152F, 0.0722F}, {0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.0F}},
                                     {{0.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, 1.0F}}};
constexpr AnaglyphMix least_squares = {
    {{0.437F, 0.449F, 0.164F}, {-0.062F, -0.062F, -0.024F}, {-0.048F, -0.050F, -0.017F}},
    {{-0.011F, -0.032F, -0.007F}, {0.377F, 0.761F, 0.009F}, {-0.026F, -0.093F, 1.234F}}};

Picture anaglyph(const Picture& left, const Picture& right, const AnaglyphMix& mix) {
  Picture mixed = like(left, {left.width, left.height});
  const bool heat_map = left.heat_range.has_value();
  // The result is display light, which a gamma of 1 leaves unchanged.
  mixed.tone = {ToneCurve::gamma, 1.0F, 1.0F, 1.0F};
  const auto shown = [&](const Picture& eye, std::size_t at) {
    const float light = heat_map ? eye.rgba[at] : toned(eye.tone, eye.rgba[at]);
    return light > 0.0F ? std::min(light, 1.0F) : 0.0F;
  };
  parallel_for(mixed.height, 16, [&](int begin, int end) {
    for (std::size_t at = position(mixed, 0, begin); at < position(mixed, 0, end); at += channels) {
      const float l[3] = {shown(left, at), shown(left, at + 1), shown(left, at + 2)};
      const float r[3] = {shown(right, at), shown(right, at + 1), shown(right, at + 2)};
      for (std::size_t c = 0; c < 3; ++c) {
        float sum = 0.0F;
        for (std::size_t i = 0; i < 3; ++i) {
          sum += mix.of_left[c][i] * l[i] + mix.of_right[c][i] * r[i];
        }
        mixed.rgba[at + c] = std::clamp(sum, 0.0F, 1.0F);
      }
      mixed.rgba[at + 3] = 0.5F * (left.rgba[at + 3] + right.rgba[at + 3]);
    }
  });
  return mixed;
}

Picture arranged(const Picture& left, const Picture& right, StereoLayout layout) {
  switch (layout) {
    case StereoLayout::mono:
      return left;
    case StereoLayout::top_bottom:
      return above(left, right);
    case StereoLayout::half_side_by_side:
      return beside(squeezed(left, 2, 1), squeezed(right, 2, 1));
    case StereoLayout::half_top_bottom:
      return above(squeezed(left, 1, 2), squeezed(right, 1, 2));
    case StereoLayout::rows:
      return interleaved(left, right);
    case StereoLayout::anaglyph:
      return anaglyph(left, right, half_colour);
    case StereoLayout::dubois:
      return anaglyph(left, right, least_squares);
    default:
      return beside(left, right);
  }
}

void dim(Picture& picture, const float (&factor)[3]) {
  for (std::size_t at = 0; at < picture.rgba.size(); at += channels) {
    // Black parts get a slight tint, so that the shadow and the frame are tinted as well.
    const float minimum = 0.02F * picture.rgba[at + 3];
    for (std::size_t c = 0; c < 3; ++c) {
      picture.rgba[at + c] = factor[c] * (picture.rgba[at + c] + minimum);
    }
  }
}

}  // namespace

ImageSize layout_size(StereoLayout layout, ImageSize eye) {
  switch (layout) {
    case StereoLayout::side_by_side:
    case StereoLayout::quad_buffer:
      return {2 * eye.width, eye.height};
    case StereoLayout::top_bottom:
      return {eye.width, 2 * eye.height};
    case StereoLayout::half_side_by_side:
      return {2 * ((eye.width + 1) / 2), eye.height};
    case StereoLayout::half_top_bottom:
      return {eye.width, 2 * ((eye.height + 1) / 2)};
    default:
      return eye;
  }
}

ImageSize window_picture_size(StereoLayout layout, ImageSize eye) {
  return fills_window_by_eye(layout) ? eye
                                     : layout_size(keeps_eyes_apart(layout) ? StereoLayout::side_by_side : layout, eye);
}

EyeGrid eye_grid(StereoLayout layout) {
  switch (layout) {
    case StereoLayout::separate:
    case StereoLayout::multiview:
    case StereoLayout::side_by_side:
      return {2, 1};
    case StereoLayout::half_side_by_side:
      return {2, 1, 0.5, 1.0};
    case StereoLayout::top_bottom:
      return {1, 2};
    case StereoLayout::half_top_bottom:
      return {1, 2, 1.0, 0.5};
    default:
      return {1, 1};
  }
}

Picture joined_eyes(const Picture& left, const Picture& right, StereoLayout layout) {
  Picture joined = arranged(left, right, layout);
  joined.behind = left.behind || right.behind;
  joined.unresolved_pixels = left.unresolved_pixels + right.unresolved_pixels;
  return joined;
}

Picture copied_picture(const Picture& picture) {
  Picture made = frame_like(picture, {picture.width, picture.height});
  made.behind = picture.behind;
  made.stars = picture.stars;
  made.rgba.resize(numbers_of(made));
  copy_to(made, picture, 0, 0);
  return made;
}

void tint_left_eye(Picture& picture) { dim(picture, {1.0F, tint, tint}); }

void tint_right_eye(Picture& picture) { dim(picture, {tint, 1.0F, 1.0F}); }

}  // namespace ergodome
