#include "render/frame/eye_renderer.h"

#include <algorithm>
#include <cmath>

#include "kernels/launch/parallel_for.h"
#include "kernels/launch/work_counter.h"
#include "kernels/projection/pixel_measure.h"
#include "render/passes/effects/bloom_across_seams.h"
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

//! Blackens pixels outside the image: halos and spikes extend beyond its edge.
void clear_outside(const Projection& projection, Picture& picture) {
  static WorkCounter counter("clear_outside");
  const WorkScope work(counter, static_cast<long>(picture.width) * picture.height);
  parallel_for(picture.height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        if (!(image_coverage(projection, x + 0.5, y + 0.5) > 0.0)) {
          const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width);
          std::fill_n(picture.rgba.begin() + static_cast<long>(4 * (at + static_cast<std::size_t>(x))), 3, 0.0F);
        }
      }
    }
  });
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

LensPixels EyeRenderer::channels(std::size_t pixels, const PictureSettings& settings, bool second) {
  const LensChannels wanted = lens_channels(settings.mode, {settings.filter, settings.shift, settings.brightening});
  const auto count = static_cast<std::size_t>(wanted.floats());
  Buffer<float>& room = second ? second_lens_ : lens_;
  if (room.size() < count * pixels) {
    room = Buffer<float>(backend_, count * pixels, second ? "second lens channels" : "lens channels");
  }
  float* next = room.data();
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

float* EyeRenderer::room_for(std::size_t pixels) {
  if (rgba_.size() < 4 * pixels) {
    rgba_ = Buffer<float>(backend_, 4 * pixels, "picture");
  }
  return rgba_.data();
}

void EyeRenderer::filter_polygons(const ShadeBatch& shade, const PolygonFilter& polygons) {
  if (backend_ == Backend::cpu) {
    return polygons.filter(shade.lens, shade.count, shade.rgba);
  }
  const auto pixels = static_cast<std::size_t>(shade.count);
  std::vector<float> values(14 * pixels);
  float* next = values.data() + 4 * pixels;
  const auto fetch = [&](const float* channel) {
    copy_to_host(backend_, next, channel, pixels);
    next += pixels;
    return next - pixels;
  };
  LensPixels lens{};
  for (int i = 0; i < 3; ++i) {
    lens.sky[i] = fetch(shade.lens.sky[i]);
    lens.sky_along_x[i] = fetch(shade.lens.sky_along_x[i]);
    lens.sky_along_y[i] = fetch(shade.lens.sky_along_y[i]);
  }
  lens.coverage = fetch(shade.lens.coverage);
  polygons.filter(lens, shade.count, values.data());
  rgba_.write(values.data(), 4 * pixels);
}

void EyeRenderer::shade_rows(ShadeBatch& shade, const PolygonFilter* polygons, const RowBlock& rows) {
  shade.first_row = rows.first;
  shade.count = rows.count * shade.projection.width_px;
  if (shade.mode == ViewMode::sky && shade.filter == SkyFilter::polygon) {
    filter_polygons(shade, *polygons);
  }
  shade_pixels(backend_, shade);
}

ShadeBatch EyeRenderer::prepare(const Projection& projection, const SkyCube& sky, const PictureSettings& settings,
                                std::size_t pixels) {
  const LensPixels lens = channels(pixels, settings);
  ShadeBatch shade{lens,
                   sky.view(),
                   settings.mode,
                   settings.filter,
                   settings.shift,
                   settings.brightening,
                   settings.colours,
                   converted_projection<float>(projection),
                   0,
                   settings.exposure,
                   0.0F,
                   1.0F,
                   nullptr,
                   0};
  if (settings.mode != ViewMode::sky) {
    set_kernel_range(shade, heat_range(settings));
  }
  return shade;
}

std::future<FoundPoints> EyeRenderer::seek_stars(const EyeCamera& eye, const Projection& projection,
                                                 const PictureSettings& settings) const {
  // The CPU part of the star search overlaps GPU rendering.
  const bool meanwhile = settings.stars != nullptr && backend_ != Backend::cpu;
  return std::async(meanwhile ? std::launch::async : std::launch::deferred, [this, &eye, &projection, &settings] {
    const UrgentDeviceWork urgent(backend_);
    const StarEye seen_by = settings.turning ? StarEye(settings.turning) : StarEye(eye);
    const PixelMatch match = settings.moment.patience_s < ShowMoment::forever_s ? PixelMatch::about : PixelMatch::exact;
    return settings.stars != nullptr ? settings.stars->find_points(seen_by, projection, settings.shutter, match)
                                     : FoundPoints();
  });
}

std::unique_ptr<LensSource> EyeRenderer::lens_for(const EyeCamera& eye, const Projection& projection,
                                                  const PictureSettings& settings) {
  if (settings.follow) {
    return std::make_unique<FollowLens>(backend_, eye, projection, settings.accuracy.tolerance_px, *settings.follow);
  }
  return lenses_.choose(
      {settings.lens, eye, projection, settings.mode, settings.accuracy, settings.moment, settings.scheme});
}

PictureInPlace EyeRenderer::render_in_place(const EyeCamera& eye, const Projection& projection, const SkyCube& sky,
                                            const PictureSettings& settings) {
  const DeviceWorkInOrder in_order(backend_);
  const std::size_t pixels =
      static_cast<std::size_t>(projection.width_px) * static_cast<std::size_t>(projection.height_px);
  ShadeBatch shade = prepare(projection, sky, settings, pixels);
  shade.rgba = room_for(pixels);
  std::future<FoundPoints> seeking = seek_stars(eye, projection, settings);
  const auto source = lens_for(eye, projection, settings);
  near_field_ = near_field_of(eye, projection, settings);
  source->fill(0, projection.height_px, shade.lens);
  shade_rows(shade, settings.polygons, {0, projection.height_px});
  const FoundPoints stars = seeking.get();
  place_stars(stars, projection, settings);
  if (!stars.empty()) {
    tiled_stars_.draw(0, projection.height_px, shade.rgba);
  }
  draw_near_rows(eye, projection, settings, {0, projection.height_px}, shade.rgba);
  draw_objects_in_place(eye, projection, settings);
  return {rgba_.data(), source->name(), source->behind()};
}

NearField EyeRenderer::near_field_of(const EyeCamera& eye, const Projection& projection,
                                     const PictureSettings& settings) {
  NearField near_field = settings.near_field;
  const bool own_lens = settings.given == nullptr && settings.turning == nullptr;
  if (own_lens && is_disk_without_shells(near_field) && may_read_disk_grid(backend_, settings.lens, settings.scheme)) {
    const DiskLook disk = near_field.disk->look_at(settings.time_s);
    const double pixels = static_cast<double>(projection.width_px) * projection.height_px;
    const DiskGridRequest request = {
        eye, disk, pixel_angle(projection), settings.accuracy.budget_px, pixels, settings.lens == LensChoice::live};
    near_field.disk_grid = streamed_disk_.layers_for(request, settings.lens, settings.moment.time_s);
    if (!near_field.disk_grid) {
      near_field.disk_grid = disk_grids_.grid_for(request);
    }
  }
  return near_field;
}

void EyeRenderer::draw_near_rows(const EyeCamera& eye, const Projection& projection, const PictureSettings& settings,
                                 const RowBlock& rows, float* rgba) const {
  if (!near_field_.empty()) {
    const PictureView view = {eye, settings.turning.get(), projection, settings.accuracy.tolerance_px, settings.time_s};
    draw_near_field(backend_, near_field_, view, rows, rgba);
  }
}

void EyeRenderer::draw_objects_in_place(const EyeCamera& eye, const Projection& projection,
                                        const PictureSettings& settings) {
  if (settings.objects == nullptr) {
    return;
  }
  if (backend_ == Backend::cpu) {
    return settings.objects->draw(eye, projection, settings.time_s, rgba_.data(), settings.turning_view.get());
  }
  std::vector<float> picture(4 * static_cast<std::size_t>(projection.width_px) *
                             static_cast<std::size_t>(projection.height_px));
  rgba_.read(picture.data(), picture.size());
  settings.objects->draw(eye, projection, settings.time_s, picture.data(), settings.turning_view.get());
  rgba_.write(picture.data(), picture.size());
}

void EyeRenderer::place_stars(const FoundPoints& stars, const Projection& projection, const PictureSettings& settings) {
  if (stars.empty()) {
    return;
  }
  const SplatSettings splat = settings.stars->splat_for(projection);
  const DiffractionPattern* const spikes = settings.stars->spikes();
  if (stars.in_place.count > 0) {
    tiled_stars_.set(stars.in_place, projection, splat, spikes);
  } else {
    tiled_stars_.set(stars.in_host, projection, splat, spikes);
  }
}

void EyeRenderer::finish(Picture& picture, const Projection& projection, const PictureSettings& settings) {
  if (settings.bloom) {
    add_bloom(picture, projection, *settings.bloom);
  }
  if (settings.clear_outside) {
    clear_outside(projection, picture);
  }
}

}  // namespace ergodome
