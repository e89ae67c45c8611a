#include "calibration/projectors/setup_conversion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/formats/mpcdi/mpcdi_conversion.h"
#include "calibration/projectors/projector_files.h"
#include "calibration/warps/warp_conversion.h"
#include "calibration/warps/warp_thinning.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

double part(const Vector3<double>& v, std::size_t channel) { return channel == 0 ? v.x : channel == 1 ? v.y : v.z; }

//! Returns a channel of a mask at a position of the raster (0 to 1, y down), linear between
//! samples; 1 without a mask.
double channel_at(const BlendMap& mask, double x, double y, std::size_t channel) {
  if (mask.width == 0) {
    return 1.0;
  }
  const double column = std::clamp(x * mask.width - 0.5, 0.0, mask.width - 1.0);
  const double row = std::clamp(y * mask.height - 0.5, 0.0, mask.height - 1.0);
  const int left = std::min(static_cast<int>(column), mask.width - 2);
  const int top = std::min(static_cast<int>(row), mask.height - 2);
  const auto channels = static_cast<std::size_t>(mask.channels);
  const auto sample = [&](int i, int j) -> double {
    const std::size_t at =
        static_cast<std::size_t>(j) * static_cast<std::size_t>(mask.width) + static_cast<std::size_t>(i);
    return mask.values[channels * at + (channels == 3 ? channel : 0)];
  };
  const double across = column - left;
  return std::lerp(std::lerp(sample(left, top), sample(left + 1, top), across),
                   std::lerp(sample(left, top + 1), sample(left + 1, top + 1), across), row - top);
}

//! The axes of the dome as an MPCDI frame: yaw down, pitch right, roll to the front.
constexpr MpcdiFrame dome_frame = {{0, 0, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}};

//! Returns a direction or position in the axes of the domemaster: relative to an untilted dome, and
//! rotated around the dome's axis like the image, so that the front of the domemaster is in front.
Vector3<double> in_own_axes(const DomeSetup& setup, const Vector3<double>& v) {
  const double tilt = one_degree * setup.tilt_deg;
  const double turn = one_degree * setup.rotation_deg;
  const double back = std::sin(tilt) * v.y + std::cos(tilt) * v.z;
  return {std::cos(turn) * v.x + std::sin(turn) * back, std::cos(tilt) * v.y - std::sin(tilt) * v.z,
          std::cos(turn) * back - std::sin(turn) * v.x};
}

Orientation in_own_axes(const DomeSetup& setup, const Orientation& orientation) {
  if (setup.tilt_deg == 0.0 && setup.rotation_deg == 0.0) {
    return orientation;
  }
  const ProjectorAxes axes = axes_of(orientation);
  return orientation_of(
      {in_own_axes(setup, axes.right), in_own_axes(setup, axes.up), in_own_axes(setup, axes.forward)});
}

//! Number of samples in a warp's map: one for each pixel, or as few as are accurate enough.
enum class MapSamples { each_pixel, as_needed };

//! Returns a region of profile 2d for a projector, whichever files its setup names.
MpcdiRegion flat_region(const ProjectorPicture& picture, MapSamples samples) {
  // Resamples the warp to a node per pixel, because masks have a sample per pixel.
  const WarpMesh fine = resampled_warp(picture.warp, picture.width_px, picture.height_px);
  MpcdiRegion region;
  region.id = picture.name;
  region.resolution_x = picture.width_px;
  region.resolution_y = picture.height_px;
  region.geometry =
      MpcdiGeometry{samples == MapSamples::as_needed
                        ? thinned_map(picture.warp, fine)
                        : map_from_warp(fine, picture.width_px, picture.height_px, TextureDirection::downwards)};
  put_light(picture, mask_from_warp(fine, picture.width_px, picture.height_px), region);
  return region;
}

//! Computes the warps and masks of a setup's projectors at their first use, because this reads all
//! files.
class PicturesOnce {
 public:
  explicit PicturesOnce(const DomeSetup& setup) : setup_(setup) {}

  const ProjectorPicture& at(std::size_t index) {
    if (pictures_.empty()) {
      pictures_ = projector_pictures(setup_);
    }
    return pictures_[index];
  }

 private:
  const DomeSetup& setup_;
  std::vector<ProjectorPicture> pictures_;
};

MpcdiRegion posed_region(const DomeSetup& setup, std::size_t index, const LoadedProjector& loaded,
                         const Frustum& frustum, PicturesOnce& pictures) {
  const ProjectorSetup& projector = setup.projectors[index];
  MpcdiRegion region;
  region.id = projector.name;
  region.resolution_x = projector.width_px;
  region.resolution_y = projector.height_px;
  region.orientation = in_own_axes(setup, loaded.orientation);
  region.frustum = frustum;
  region.frame = dome_frame;
  region.frame->position = in_own_axes(setup, loaded.position_m);
  region.unit = "m";
  const std::optional<MpcdiMask> beta =
      beta_of(loaded.black_level.value_or(BlendMap{}), loaded.black_level_lift, projector.gain);
  if (has_gain(projector.gain) || (beta && !loaded.blend)) {
    // A setup that names this file for its masks no longer computes the blend from lenses and
    // positions, so the alphaMap must include it.
    const auto pixels = static_cast<std::size_t>(projector.width_px) * static_cast<std::size_t>(projector.height_px);
    put_light(pictures.at(index), {projector.width_px, projector.height_px, 1, 16, std::vector<float>(pixels, 1.0F)},
              region);
    return region;
  }
  region.decode_gamma = 1.0;
  region.encode_gamma = projector.gamma;
  region.alpha = loaded.blend;
  region.beta = beta;
  return region;
}

//! Returns a region of profile sl for each projector, with its flat lens, pose and masks; nothing
//! if one of them has a warp, a mirror or another lens.
std::optional<std::vector<MpcdiRegion>> posed_regions(const DomeSetup& setup) {
  std::vector<MpcdiRegion> regions;
  PicturesOnce pictures(setup);
  for (std::size_t i = 0; i < setup.projectors.size(); ++i) {
    const ProjectorSetup& projector = setup.projectors[i];
    const LoadedProjector loaded = load_projector(setup, projector);
    const auto* const frustum = std::get_if<Frustum>(&loaded.lens);
    if (frustum == nullptr || !std::holds_alternative<std::monostate>(loaded.warp) || projector.mirror) {
      return std::nullopt;
    }
    regions.push_back(posed_region(setup, i, loaded, *frustum, pictures));
  }
  return regions;
}

Mpcdi calibration_of(MpcdiProfile profile, std::vector<MpcdiRegion> regions, const std::string& date) {
  Mpcdi mpcdi = media_calibration(std::move(regions), date);
  mpcdi.profile = profile;
  const bool lifted =
      std::ranges::any_of(mpcdi.buffers[0].regions, [](const MpcdiRegion& region) { return !!region.beta; });
  mpcdi.color_level = lifted ? 3 : 1;
  return mpcdi;
}

}  // namespace

bool has_gain(const Vector3<double>& gain) { return gain.x != 1.0 || gain.y != 1.0 || gain.z != 1.0; }

std::optional<MpcdiMask> beta_of(const BlendMap& black_level, const Vector3<double>& lift,
                                 const Vector3<double>& gain) {
  if (!(lift.x > 0.0 || lift.y > 0.0 || lift.z > 0.0)) {
    return std::nullopt;
  }
  const BlendMap mask = black_level.width > 0 ? black_level : BlendMap{2, 2, 1, 16, std::vector<float>(4, 1.0F)};
  BlendMap beta{mask.width, mask.height, 3, 16, {}};
  beta.values.reserve(3 * mask.values.size() / static_cast<std::size_t>(mask.channels));
  for (std::size_t i = 0; i < mask.values.size(); i += static_cast<std::size_t>(mask.channels)) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = mask.values[mask.channels == 3 ? i + c : i];
      beta.values.push_back(static_cast<float>(std::clamp(value * part(lift, c) * part(gain, c), 0.0, 1.0)));
    }
  }
  return MpcdiMask{std::move(beta), 1.0};
}

void put_light(const ProjectorPicture& picture, const BlendMap& intensity, MpcdiRegion& region) {
  region.decode_gamma = 1.0;
  region.encode_gamma = picture.gamma;
  region.beta = beta_of(picture.black_level, picture.black_level_lift, picture.gain);
  const std::size_t channels = has_gain(picture.gain) || picture.blend.channels == 3 ? 3 : 1;
  BlendMap alpha{intensity.width, intensity.height, static_cast<int>(channels), 16, {}};
  alpha.values.reserve(channels * intensity.values.size());
  for (std::size_t i = 0; i < intensity.values.size(); ++i) {
    const auto width = static_cast<std::size_t>(intensity.width);
    const std::size_t row = i / width;
    const double x = (static_cast<double>(i - row * width) + 0.5) / intensity.width;
    const double y = (static_cast<double>(row) + 0.5) / intensity.height;
    for (std::size_t c = 0; c < channels; ++c) {
      const double gain = part(picture.gain, c);
      const double lift = part(picture.black_level_lift, c) * channel_at(picture.black_level, x, y, c);
      const double room = 1.0 - gain * lift;
      const double held = room > 0.0 ? gain * (1.0 - lift) / room : 0.0;
      const double factor = held * intensity.values[i] * channel_at(picture.blend, x, y, c);
      alpha.values.push_back(static_cast<float>(std::clamp(factor, 0.0, 1.0)));
    }
  }
  region.alpha = MpcdiMask{std::move(alpha), 1.0};
}

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
      // The setup names the file as a warp even if the file provides only masks.
      if (region.geometry || !region.orientation || region.alpha || region.beta) {
        projector.warp = WarpFile{file, WarpFormat::mpcdi, RowOrder::bottom_up, TextureDirection::downwards, region.id};
      }
      projector.gamma = region.encode_gamma.value_or(projector.gamma);
      setup.projectors.push_back(std::move(projector));
    }
  }
  return setup;
}

Mpcdi mpcdi_from_pictures(const std::vector<ProjectorPicture>& pictures, const std::string& date,
                          const std::function<void(long)>& progress) {
  std::vector<MpcdiRegion> regions;
  for (const ProjectorPicture& picture : pictures) {
    regions.push_back(flat_region(picture, MapSamples::as_needed));
    if (progress) {
      progress(static_cast<long>(regions.size()));
    }
  }
  return calibration_of(MpcdiProfile::media_2d, std::move(regions), date);
}

Mpcdi mpcdi_from_setup(const DomeSetup& setup, const std::string& date) {
  std::optional<std::vector<MpcdiRegion>> posed = posed_regions(setup);
  if (posed) {
    return calibration_of(MpcdiProfile::shader_lamps, std::move(*posed), date);
  }
  std::vector<MpcdiRegion> flat;
  for (const ProjectorPicture& picture : projector_pictures(setup)) {
    flat.push_back(flat_region(picture, MapSamples::each_pixel));
  }
  return calibration_of(MpcdiProfile::media_2d, std::move(flat), date);
}

std::string tilt_note(const DomeSetup& setup, const Mpcdi& mpcdi) {
  if (setup.tilt_deg == 0.0) {
    return {};
  }
  const bool flat = mpcdi.profile == MpcdiProfile::media_2d;
  // With positions in the dome's axes, stating tilt_deg would apply the tilt again; with warps,
  // stating rotation_deg would rotate them again.
  const std::string remedy = flat && setup.rotation_deg == 0.0
                                 ? fmt::format("set tilt_deg = {:g} in setups converted from it", setup.tilt_deg)
                                 : std::string("keep the original setup");
  return fmt::format(
      "; its {} include tilt_deg and rotation_deg, which MPCDI does not store: for level test patterns, {}",
      flat ? "warps" : "positions", remedy);
}

}  // namespace ergodome
