#include "calibration/setup_conversion.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "calibration/mpcdi_conversion.h"
#include "calibration/projector_files.h"
#include "calibration/projector_picture.h"

namespace ergodome {

namespace {

//! The axes of the dome as MPCDI tells axes: yaw down, pitch right, roll to the front.
constexpr MpcdiFrame dome_frame = {{0, 0, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}};

//! A grey or coloured black level times its lift, as a mask in colour.
BlendMap beta_of(const BlendMap& black_level, const Vector3<double>& lift) {
  const BlendMap mask = black_level.width > 0 ? black_level : BlendMap{2, 2, 1, 16, std::vector<float>(4, 1.0F)};
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

//! What a projector shows of the domemaster, whatever it was made from.
MpcdiRegion flat_region(const ProjectorPicture& picture) {
  // For each pixel, because a mask is finer than the nodes of most meshes.
  WarpMesh fine = resampled_warp(picture.warp, picture.width_px, picture.height_px);
  if (picture.blend.width > 0) {
    multiply_intensity(fine, picture.blend, 1.0);
  }
  MpcdiRegion region =
      region_from_warp(picture.name, fine, picture.width_px, picture.height_px, picture.width_px, picture.height_px);
  region.encode_gamma = picture.gamma;
  const Vector3<double>& lift = picture.black_level_lift;
  if (lift.x > 0.0 || lift.y > 0.0 || lift.z > 0.0) {
    region.beta = MpcdiMask{beta_of(picture.black_level, lift), 1.0};
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

//! The flat lenses and places of all projectors; none where one of them has something else, too.
std::optional<std::vector<MpcdiRegion>> posed_regions(const DomeSetup& setup) {
  std::vector<MpcdiRegion> regions;
  for (const ProjectorSetup& projector : setup.projectors) {
    const LoadedProjector loaded = load_projector(setup, projector);
    const auto* const frustum = std::get_if<Frustum>(&loaded.lens);
    if (frustum == nullptr || !std::holds_alternative<std::monostate>(loaded.warp) || projector.mirror) {
      return std::nullopt;
    }
    regions.push_back(posed_region(projector, loaded, *frustum));
  }
  return regions;
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
  std::optional<std::vector<MpcdiRegion>> posed = posed_regions(setup);
  std::vector<MpcdiRegion> flat;
  if (!posed) {
    std::ranges::transform(projector_pictures(setup), std::back_inserter(flat), flat_region);
  }
  Mpcdi mpcdi = media_calibration(posed ? std::move(*posed) : std::move(flat), date);
  mpcdi.profile = posed ? MpcdiProfile::shader_lamps : MpcdiProfile::media_2d;
  const bool lifted =
      std::ranges::any_of(mpcdi.buffers[0].regions, [](const MpcdiRegion& region) { return !!region.beta; });
  mpcdi.color_level = lifted ? 3 : 1;
  return mpcdi;
}

}  // namespace ergodome
