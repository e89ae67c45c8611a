#include "calibration/setup_conversion.h"

#include <fmt/format.h>

#include <algorithm>

#include "calibration/mpcdi_conversion.h"
#include "calibration/projector_files.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! The axes of the dome as MPCDI tells axes: yaw down, pitch right, roll to the front.
constexpr MpcdiFrame dome_frame = {{0, 0, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}};

//! A grey or coloured black level times its lift, as a mask in colour.
BlendMap beta_of(const std::optional<BlendMap>& black_level, const Vector3<double>& lift) {
  const BlendMap mask = black_level ? *black_level : BlendMap{2, 2, 1, 16, std::vector<float>(4, 1.0F)};
  const double lifts[] = {lift.x, lift.y, lift.z};
  BlendMap beta{mask.width, mask.height, 3, 16, {}};
  beta.values.reserve(3 * mask.values.size() / static_cast<std::size_t>(mask.channels));
  for (std::size_t i = 0; i < mask.values.size(); i += static_cast<std::size_t>(mask.channels)) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = mask.values[mask.channels == 3 ? i + c : i];
      beta.values.push_back(static_cast<float>(std::clamp(value * lifts[c], 0.0, 1.0)));
    }
  }
  return beta;
}

MpcdiRegion flat_region(const ProjectorSetup& projector, const LoadedProjector& loaded, const WarpMesh& warp) {
  // For each pixel, because a mask is finer than the nodes of most meshes.
  WarpMesh fine = resampled_warp(warp, projector.width_px, projector.height_px);
  if (loaded.blend) {
    multiply_intensity(fine, loaded.blend->map, loaded.blend->gamma_embedded);
  }
  MpcdiRegion region = region_from_warp(projector.name, fine, projector.width_px, projector.height_px,
                                        projector.width_px, projector.height_px);
  region.encode_gamma = projector.gamma;
  const Vector3<double>& lift = loaded.black_level_lift;
  if (lift.x > 0.0 || lift.y > 0.0 || lift.z > 0.0) {
    region.beta = MpcdiMask{beta_of(loaded.black_level, lift), 1.0};
  }
  return region;
}

MpcdiRegion posed_region(const ProjectorSetup& projector, const LoadedProjector& loaded, const Frustum& frustum) {
  MpcdiRegion region;
  region.id = projector.name;
  region.resolution_x = projector.width_px;
  region.resolution_y = projector.height_px;
  region.orientation = loaded.orientation;
  region.frustum = frustum;
  region.frame = dome_frame;
  region.frame->position = loaded.position_m;
  region.encode_gamma = projector.gamma;
  region.alpha = loaded.blend;
  return region;
}

}  // namespace

DomeSetup setup_from_mpcdi(const Mpcdi& mpcdi, const std::string& file, double radius_m) {
  DomeSetup setup;
  setup.radius_m = radius_m;
  int left_px = 0;
  for (const MpcdiBuffer& buffer : mpcdi.buffers) {
    for (const MpcdiRegion& region : buffer.regions) {
      ProjectorSetup projector;
      projector.name = region.id;
      projector.width_px = region.resolution_x;
      projector.height_px = region.resolution_y;
      projector.output.window_x_px = left_px;
      left_px += region.resolution_x;
      if (region.orientation) {
        const ProjectorPose pose = pose_of(region);
        projector.lens = lens_of(region);
        projector.position_m = pose.position_m;
        projector.orientation = pose.orientation;
      }
      if (region.geometry || !region.orientation) {
        projector.warp = WarpFile{file, WarpFormat::mpcdi, RowOrder::bottom_up, TextureDirection::downwards, region.id};
      }
      projector.gamma = region.encode_gamma != 1.0 ? region.encode_gamma : projector.gamma;
      setup.projectors.push_back(std::move(projector));
    }
  }
  return setup;
}

Mpcdi mpcdi_from_setup(const DomeSetup& setup, const std::string& date) {
  std::vector<MpcdiRegion> flat;
  std::vector<MpcdiRegion> posed;
  for (const ProjectorSetup& projector : setup.projectors) {
    const LoadedProjector loaded = load_projector(setup, projector);
    const auto* const warp = std::get_if<WarpMesh>(&loaded.warp);
    const auto* const frustum = std::get_if<Frustum>(&loaded.lens);
    const bool bare = std::holds_alternative<std::monostate>(loaded.warp);
    if (warp != nullptr && loaded.source == WarpSource::dome_picture) {
      flat.push_back(flat_region(projector, loaded, *warp));
    } else if (frustum != nullptr && bare && !projector.mirror) {
      posed.push_back(posed_region(projector, loaded, *frustum));
    }
    if (flat.size() + posed.size() != 1 + static_cast<std::size_t>(&projector - setup.projectors.data()) ||
        (!flat.empty() && !posed.empty())) {
      throw Error(
          "", fmt::format("projector \"{}\" does not fit into one MPCDI profile with the others", projector.name),
          "give every projector a flat warp, as `ergodome calibrate --mpcdi` does, or every one a flat lens without "
          "warp and mirror");
    }
  }
  const bool posed_alone = flat.empty();
  Mpcdi mpcdi = media_calibration(posed_alone ? std::move(posed) : std::move(flat), date);
  mpcdi.profile = posed_alone ? MpcdiProfile::shader_lamps : MpcdiProfile::media_2d;
  const auto& regions = mpcdi.buffers[0].regions;
  const bool lifted =
      std::any_of(regions.begin(), regions.end(), [](const MpcdiRegion& region) { return !!region.beta; });
  mpcdi.color_level = lifted ? 3 : 1;
  return mpcdi;
}

}  // namespace ergodome
