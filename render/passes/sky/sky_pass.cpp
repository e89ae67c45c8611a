#include "render/passes/sky/sky_pass.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/launch/cuda.h"
#include "kernels/launch/launch.h"
#include "render/passes/sky/sky_shading.h"

namespace ergodome {

namespace {

//! Sets the ends of the color bar in the kernel's unit for a channel
//! (kernels/image/shade_pixels_kernel.h).
void set_kernel_range(ShadeBatch& batch, const HeatRange& range) {
  const auto measure = [&](double value) {
    switch (batch.mode) {
      case ViewMode::steps:
        return range.logarithmic ? std::log10(value) : value;
      case ViewMode::error_estimate:
      case ViewMode::magnification:
        return std::log10(value);
      case ViewMode::frequency_ratio:
        return std::log2(value);
      default:
        return value;
    }
  };
  batch.range_low = static_cast<float>(measure(range.low));
  batch.range_high = static_cast<float>(measure(range.high));
}

std::size_t sky_pixels(const EyePicture& picture, int rows) {
  return static_cast<std::size_t>(picture.projection.width_px) * static_cast<std::size_t>(rows);
}

//! Returns the shading of a picture, except for the channels and its output.
ShadeBatch shading_for(const EyePicture& picture, const SkyCube& sky) {
  const PictureSettings& settings = picture.settings;
  ShadeBatch shade{{},
                   sky.view(),
                   settings.mode,
                   settings.filter,
                   settings.shift,
                   settings.brightening,
                   settings.colours,
                   converted_projection<float>(picture.projection),
                   0,
                   settings.exposure,
                   0.0F,
                   1.0F,
                   nullptr,
                   0};
  shade.opacity = settings.stars_apart != nullptr;
  if (settings.mode != ViewMode::sky) {
    set_kernel_range(shade, heat_range(settings));
  }
  return shade;
}

}  // namespace

HeatRange heat_range(const PictureSettings& settings) {
  HeatRange range = heat_range(settings.mode, settings.follow && settings.follow->logarithmic);
  if (settings.range) {
    range.low = settings.range->low;
    range.high = settings.range->high;
  }
  return range;
}

std::unique_ptr<LensSource> SkyPass::lens_for(const EyeCamera& eye, const Projection& projection,
                                              const PictureSettings& settings) {
  if (settings.follow) {
    return std::make_unique<FollowLens>(backend_, eye, projection, settings.accuracy.tolerance_px, *settings.follow);
  }
  return lenses_.choose(
      {settings.lens, eye, projection, settings.mode, settings.accuracy, settings.moment, settings.scheme});
}

LensPixels SkyPass::channels(std::size_t pixels, const PictureSettings& settings) {
  const LensChannels wanted = lens_channels(settings.mode, {settings.filter, settings.shift, settings.brightening});
  const auto count = static_cast<std::size_t>(wanted.floats());
  if (lens_.size() < count * pixels) {
    lens_ = Buffer<float>(backend_, count * pixels, "lens channels");
  }
  float* next = lens_.data();
  const auto take = [&](bool needed) {
    float* channel = needed ? next : nullptr;
    next += needed ? pixels : 0;
    return channel;
  };
  LensPixels lens{};
  lens.coverage = take(true);
  lens.error_estimate = take(true);
  for (int i = 0; i < 3; ++i) {
    lens.sky[i] = take(wanted.sky);
    lens.sky_along_x[i] = take(wanted.footprint);
    lens.sky_along_y[i] = take(wanted.footprint);
  }
  lens.frequency_ratio = take(wanted.frequency_ratio);
  lens.steps = take(wanted.steps);
  lens.half_orbits = take(wanted.half_orbits);
  return lens;
}

SkyDrawing::SkyDrawing(SkyPass& pass, const EyePicture& picture, const SkyCube& sky, int max_rows)
    : pass_(pass),
      picture_(picture),
      max_rows_(max_rows),
      shade_(shading_for(picture, sky)),
      lens_(picture.settings.given) {
  shade_.lens = pass.channels(sky_pixels(picture, max_rows), picture.settings);
  if (lens_ == nullptr) {
    chosen_ = pass.lens_for(picture.eye, picture.projection, picture.settings);
    lens_ = chosen_.get();
  }
}

void SkyDrawing::draw(const RowBlock& rows, float* rgba) {
  // Sets the channels again, because another picture may have used the same memory meanwhile.
  shade_.lens = pass_.channels(sky_pixels(picture_, max_rows_), picture_.settings);
  aim(rows, rgba);
  shaded_by_lens_ = lens_->shade(rows.first, rows.count, shade_);
  if (!shaded_by_lens_) {
    lens_->fill(rows.first, rows.count, shade_.lens);
    shade();
  }
}

void SkyDrawing::aim(const RowBlock& rows, float* rgba) {
  shade_.rgba = rgba;
  shade_.first_row = rows.first;
  shade_.count = rows.count * shade_.projection.width_px;
}

void SkyDrawing::shade() {
  if (shade_.mode == ViewMode::sky && shade_.filter == SkyFilter::polygon) {
    filter_polygons(*picture_.settings.polygons);
  }
  launch(pass_.backend_, shade_);
}

long SkyDrawing::count_unresolved() const {
  if (shaded_by_lens_) {
    // Grids have a value for every pixel.
    return 0;
  }
  const float* const estimates = shade_.lens.error_estimate;
  return pass_.backend_ == Backend::cuda
             ? count_negative_cuda(estimates, shade_.count)
             : std::count_if(estimates, estimates + shade_.count, [](float e) { return e < 0.0F; });
}

void SkyDrawing::filter_polygons(const PolygonFilter& polygons) const {
  if (pass_.backend_ == Backend::cpu) {
    return polygons.filter(shade_.lens, shade_.count, shade_.rgba);
  }
  const auto pixels = static_cast<std::size_t>(shade_.count);
  std::vector<float> values(14 * pixels);
  float* next = values.data() + 4 * pixels;
  const auto fetch = [&](const float* channel) {
    copy_to_host(pass_.backend_, next, channel, pixels);
    next += pixels;
    return next - pixels;
  };
  LensPixels lens{};
  for (int i = 0; i < 3; ++i) {
    lens.sky[i] = fetch(shade_.lens.sky[i]);
    lens.sky_along_x[i] = fetch(shade_.lens.sky_along_x[i]);
    lens.sky_along_y[i] = fetch(shade_.lens.sky_along_y[i]);
  }
  lens.coverage = fetch(shade_.lens.coverage);
  polygons.filter(lens, shade_.count, values.data());
  copy_to_cuda(shade_.rgba, values.data(), 4 * pixels * sizeof(float));
}

}  // namespace ergodome
