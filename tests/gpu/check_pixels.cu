#include <cuda_fp16.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "kernels/image/shade_pixels_kernel.h"
#include "kernels/projection/make_projection.h"
#include "kernels/spacetime/trace/trace_pixels_kernel.h"
#include "tests/gpu/dome.cuh"

namespace ergodome::gpu_check {

namespace {

//! Returns a cube map with a smooth pattern. Unlike in the program, the borders of its faces do not
//! contain texels of adjacent faces; this does not matter when CPU and GPU are compared.
CubeMap patterned_cube(Twin<HalfQuad>& texels, int face_size) {
  CubeMap map{};
  map.scale = 0.5F;
  map.face_size = face_size;
  long offset = 0;
  for (int size = face_size; size >= 1; size /= 2) {
    map.level_offset[map.level_count++] = offset;
    offset += 6L * (size + 2) * (size + 2);
  }
  for (std::size_t i = 0; i < texels.host.size(); ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      texels.host[i].part[j] =
          __half_as_ushort(__float2half(1.0F + std::sin(0.01F * static_cast<float>((4 * i + j) % 100'000))));
    }
  }
  texels.upload();
  return map;
}

//! Settings of the sky filter for a check.
struct SkySampling {
  SkyFilter filter = SkyFilter::ewa;
  SkyShift shift = SkyShift::none;
  bool brightening = false;
};

//! Fills a table of blackbody colors with a smooth curve instead of Planck's law. This does not
//! matter when CPU and GPU are compared.
BlackbodyTable smooth_colours(Twin<float>& entries) {
  const int count = static_cast<int>(entries.host.size() / 4);
  for (int i = 0; i < count; ++i) {
    const float x = static_cast<float>(i) / static_cast<float>(count);
    const float entry[] = {20.0F * x, 1.1F - 0.2F * x, 0.1F + 1.5F * x, 0.0F};
    std::copy(entry, entry + 4, entries.host.begin() + 4 * i);
  }
  entries.upload();
  return {entries.host.data(), count, 5.7F, 0.01F};
}

bool check_shading(Twin<float>& lens, std::size_t pixels, ViewMode mode, const SkySampling& sampling,
                   const char* name) {
  Twin<HalfQuad> texels(std::size_t{6} * 2 * 514 * 514);
  Twin<float> colours(4 * 512);
  Twin<float> rgba(4 * pixels);
  ShadeBatch on_host{};
  on_host.lens = lens_at(lens.host.data(), pixels);
  on_host.sky = patterned_cube(texels, 512);
  on_host.mode = mode;
  on_host.filter = sampling.filter;
  on_host.shift = sampling.shift;
  on_host.brightening = sampling.brightening;
  on_host.colours = smooth_colours(colours);
  const int size = static_cast<int>(std::lround(std::sqrt(static_cast<double>(pixels))));
  on_host.projection = converted_projection<float>(make_dome_projection(size, 3.14159265358979, 0.5));
  on_host.exposure = 1.0F;
  on_host.range_high = 1.0F;
  on_host.rgba = rgba.host.data();
  on_host.count = static_cast<int>(pixels);
  ShadeBatch on_device = on_host;
  on_host.sky.texels = texels.host.data();
  on_device.lens = lens_at(lens.device(), pixels);
  on_device.sky.texels = texels.device();
  on_device.colours.entries = colours.device();
  on_device.rgba = rgba.device();
  const auto run = [&](auto host_functor, auto device_functor) {
    const double device_ms = run_on_device_ms(name, device_functor, on_device.count);
    const double host_ms = run_on_host_ms(host_functor, on_host.count);
    return report(name, on_host.count, device_ms, host_ms, compare(rgba.download(), rgba.host, 0.999, 1e-4));
  };
  if (mode != ViewMode::sky) {
    return run(ShadeHeatMap{on_host}, ShadeHeatMap{on_device});
  }
  bool good = false;
  dispatch_shading<float>(on_host, [&](const auto& functor) {
    auto device_functor = functor;
    device_functor.batch = on_device;
    good = run(functor, device_functor);
  });
  return good;
}

bool check_size(int size, bool compare_all) {
  const CameraStation station = make_camera_station(Spacetime{0.999}, 5.0, 1.5707963, 0.0, ObserverMotion::zamo);
  const ShadowChart chart = make_shadow_chart(station);
  Twin<float> edge(1024);
  solve_edge(station, chart, edge);
  const auto pixels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  Twin<float> lens(channel_count * pixels);
  PixelBatch on_host = dome_batch(size, edge, chart);
  PixelBatch on_device = on_host;
  on_host.out = lens_at(lens.host.data(), pixels);
  on_device.out = lens_at(lens.device(), pixels);
  on_device.edge.polar_angle = edge.device();
  const int count = static_cast<int>(pixels);
  const double device_ms = run_on_pixels_ms("trace_pixels", TracePixels<float, true>{on_device}, size);
  const double host_ms = run_on_host_ms(TracePixels<float, true>{on_host}, count);
  bool good = report("trace_pixels " + std::to_string(size) + "^2 dome", count, device_ms, host_ms,
                     compare(lens.download(), lens.host, 0.98, 1e-4));
  lens.upload();
  good = check_shading(lens, pixels, ViewMode::sky, {}, "shade sky") && good;
  if (compare_all) {
    const auto check = [&](const SkySampling& sampling, const char* name) {
      good = check_shading(lens, pixels, ViewMode::sky, sampling, name) && good;
    };
    check({SkyFilter::ewa, SkyShift::luminance, false}, "shade sky, luminance shift");
    check({SkyFilter::ewa, SkyShift::blackbody_fit, false}, "shade sky, blackbody shift");
    check({SkyFilter::ewa, SkyShift::none, true}, "shade sky, brightened");
    check({SkyFilter::point, SkyShift::none, false}, "shade sky, point samples");
    good = check_shading(lens, pixels, ViewMode::image_order, {}, "shade heat map") && good;
  }
  return good;
}

}  // namespace

bool check_pixels() {
  const bool small = check_size(1024, true);
  return check_size(4096, false) && small;
}

}  // namespace ergodome::gpu_check
