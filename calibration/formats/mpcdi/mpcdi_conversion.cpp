#include "calibration/formats/mpcdi/mpcdi_conversion.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "calibration/warps/warp_conversion.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Maximum coordinate, far outside any dome in any unit; the comparison also rejects NaN.
constexpr float largest_position = 1e7F;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr Vector3<float> unknown_position = {nan, nan, nan};

//! Converts a vector from the file's axes to the dome's axes.
Vector3<double> in_dome_axes(const MpcdiFrame& frame, const Vector3<double>& v) {
  return {dot(v, frame.pitch_axis), -dot(v, frame.yaw_axis), -dot(v, frame.roll_axis)};
}

//! The axes of 3D data without a frame: x left, y up, z to the front.
constexpr MpcdiFrame world_frame = {{0, 0, 0}, {0, -1, 0}, {-1, 0, 0}, {0, 0, 1}};

const MpcdiGeometry& geometry_of(const MpcdiRegion& region, const std::string& location) {
  if (!region.geometry) {
    throw Error(location, "region \"" + region.id + "\" has no warp file", "export the calibration with its warps");
  }
  return *region.geometry;
}

}  // namespace

WarpMesh warp_of(const Mpcdi& mpcdi, const MpcdiRegion& region, const std::string& location) {
  if (mpcdi.profile != MpcdiProfile::media_2d && mpcdi.profile != MpcdiProfile::simulation_3d) {
    throw Error(location, "contains a surface in three dimensions, not a flat warp", "export it with profile 2d or 3d");
  }
  WarpMesh mesh = warp_from_map(geometry_of(region, location).map, TextureDirection::downwards);
  if (mpcdi.profile == MpcdiProfile::media_2d) {
    for (WarpNode& node : mesh.nodes) {
      node.u = static_cast<float>(region.x + region.width * node.u);
      node.v = static_cast<float>(region.y + region.height * node.v);
    }
  }
  return mesh;
}

SurfaceMesh surface_of(const Mpcdi& mpcdi, const MpcdiRegion& region, const std::string& location) {
  if (mpcdi.profile != MpcdiProfile::advanced_3d && mpcdi.profile != MpcdiProfile::shader_lamps) {
    throw Error(location, "contains a flat warp, not a surface in three dimensions", "export it with profile a3 or sl");
  }
  const MpcdiGeometry& geometry = geometry_of(region, location);
  const bool framed = mpcdi.profile == MpcdiProfile::shader_lamps && region.frame;
  const MpcdiFrame frame = framed ? *region.frame : world_frame;
  const double metres = metres_of_unit(geometry.unit);
  SurfaceMesh surface{geometry.map.width, geometry.map.height, {}};
  surface.points.reserve(geometry.map.samples.size() / 3);
  for (std::size_t i = 0; i + 2 < geometry.map.samples.size(); i += 3) {
    const float* const sample = &geometry.map.samples[i];
    const bool known = std::all_of(sample, sample + 3, [](float c) { return std::abs(c) <= largest_position; });
    const Vector3<double> point = metres * in_dome_axes(frame, {sample[0], sample[1], sample[2]});
    surface.points.push_back(
        known ? Vector3<float>{static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z)}
              : unknown_position);
  }
  return surface;
}

ProjectorPose pose_of(const MpcdiRegion& region) {
  ProjectorPose pose;
  pose.orientation = region.orientation.value_or(Orientation{});
  if (region.frame) {
    const double metres = metres_of_unit(region.unit);
    pose.position_m = metres * in_dome_axes(*region.frame, region.frame->position);
  }
  return pose;
}

Lens lens_of(const MpcdiRegion& region) {
  if (region.fisheye) {
    ProjectorFisheye lens;
    lens.polynomial.assign(std::begin(region.fisheye->coefficients), std::end(region.fisheye->coefficients));
    lens.field_of_view_deg = std::max(1.0, 2.0 * radian_deg * growing_angle(lens.polynomial));
    lens.offset_x = region.fisheye->horizontal_offset;
    lens.offset_y = region.fisheye->vertical_offset;
    return lens;
  }
  return region.frustum ? Lens(*region.frustum) : Lens();
}

MpcdiRegion region_from_warp(const std::string& id, const WarpMesh& warp, int resolution_x, int resolution_y,
                             int map_width, int map_height) {
  MpcdiRegion region;
  region.id = id;
  region.resolution_x = resolution_x;
  region.resolution_y = resolution_y;
  region.geometry = MpcdiGeometry{map_from_warp(warp, map_width, map_height, TextureDirection::downwards)};
  region.alpha = MpcdiMask{mask_from_warp(warp, map_width, map_height), 1.0};
  return region;
}

Mpcdi media_calibration(std::vector<MpcdiRegion> regions, const std::string& date) {
  Mpcdi mpcdi;
  mpcdi.date = date;
  // Geometry level 1 allows at most 32 x 32 samples (table 3-2 of the MPCDI specification).
  const bool fine = std::any_of(regions.begin(), regions.end(), [](const MpcdiRegion& region) {
    return region.geometry && (region.geometry->map.width > 32 || region.geometry->map.height > 32);
  });
  mpcdi.geometry_level = fine ? 2 : 1;
  mpcdi.buffers.push_back({"dome", 0, 0, std::move(regions)});
  return mpcdi;
}

}  // namespace ergodome
