#include "calibration/projectors/projector_picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/projectors/dome_blend.h"
#include "calibration/projectors/dome_warp.h"
#include "calibration/warps/warp_conversion.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! Size of a preview mask's pixel, in pixels of the raster.
constexpr int preview_pixel_px = 8;

DomeScreen screen_of(const DomeSetup& setup) { return {setup.tilt_deg, 180.0}; }

//! Sets a node's texture coordinates to the position in the domemaster of a point or direction.
//! Makes the node invalid if there is no such position.
void set_position(const DomeScreen& screen, const Vector3<double>& point, WarpNode& node) {
  double u = 0.0;
  double v = 0.0;
  const bool finite = std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
  node.valid = node.valid && finite && dot(point, point) > 0.0 && master_position_near_rim(screen, point, u, v);
  node.u = static_cast<float>(u);
  node.v = static_cast<float>(v);
}

WarpMesh warp_of_surface(const DomeScreen& screen, const SurfaceMesh& surface) {
  WarpMesh mesh;
  mesh.columns = surface.columns;
  mesh.rows = surface.rows;
  mesh.nodes.resize(surface.points.size());
  for (int row = 0; row < mesh.rows; ++row) {
    for (int column = 0; column < mesh.columns; ++column) {
      WarpNode& node = mesh.at(column, row);
      node.x = static_cast<float>(fill_position(column, mesh.columns));
      node.y = static_cast<float>(fill_position(row, mesh.rows));
      const Vector3<float>& point = surface.points[static_cast<std::size_t>(&node - mesh.nodes.data())];
      set_position(screen, {point.x, point.y, point.z}, node);
    }
  }
  return with_rim(mesh);
}

//! Returns the number of steps, at most 128, into which each side of a cell must be divided so
//! that, in each step, the lens image deviates from a straight line by less than about 0.1 pixel of
//! a 4096-pixel domemaster.
int steps_through_lens(const WarpMesh& warp, const Frustum& frustum) {
  // In units of the tangent plane, in which angles are not linear: a step of 1/32 is less than 2°.
  constexpr double longest_step = 1.0 / 32.0;
  const double across = std::tan(one_degree * frustum.right_deg) - std::tan(one_degree * frustum.left_deg);
  const double upwards = std::tan(one_degree * frustum.up_deg) - std::tan(one_degree * frustum.down_deg);
  double longest = 0.0;
  const auto measure = [&](const WarpNode& a, const WarpNode& b) {
    if (a.valid && b.valid) {
      longest = std::max(longest, across * std::abs(static_cast<double>(a.u) - b.u));
      longest = std::max(longest, upwards * std::abs(static_cast<double>(a.v) - b.v));
    }
  };
  for (int row = 0; row < warp.rows; ++row) {
    for (int column = 0; column < warp.columns; ++column) {
      measure(warp.at(column, row), warp.at(std::min(column + 1, warp.columns - 1), row));
      measure(warp.at(column, row), warp.at(column, std::min(row + 1, warp.rows - 1)));
    }
  }
  constexpr double max_steps = 128.0;
  return static_cast<int>(std::ceil(std::clamp(longest / longest_step, 1.0, max_steps)));
}

WarpMesh unturned_warp(const DomeSetup& setup, const ProjectorSetup& projector, const LoadedProjector& loaded,
                       double tolerance_px) {
  const DomeScreen screen = screen_of(setup);
  if (const auto* const surface = std::get_if<SurfaceMesh>(&loaded.warp)) {
    return warp_of_surface(screen, *surface);
  }
  if (const auto* const warp = std::get_if<WarpMesh>(&loaded.warp)) {
    if (loaded.source == WarpSource::dome_picture) {
      return *warp;
    }
    if (const auto* const frustum = std::get_if<Frustum>(&loaded.lens)) {
      return through_lens(setup.tilt_deg, *warp, loaded.orientation, *frustum);
    }
    throw Error(location_of(projector), "has a warp of the lens image, but no flat lens",
                "write its frustum, or use a warp of the domemaster (MPCDI profile 2d, or source = \"domemaster\")");
  }
  ProjectorSetup placed = projector;
  placed.lens = loaded.lens;
  placed.position_m = loaded.position_m;
  placed.orientation = loaded.orientation;
  constexpr int master_px = 4096;
  return dome_warp(ProjectorOptics(setup, placed), screen, master_px, tolerance_px);
}

//! Rotates the positions in the domemaster so that the front of the domemaster is shown `angle`
//! [rad] to the right.
void turn(WarpMesh& mesh, double angle) {
  if (angle == 0.0) {
    return;
  }
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  for (WarpNode& node : mesh.nodes) {
    const double right = node.u - 0.5;
    const double front = node.v - 0.5;
    node.u = static_cast<float>(0.5 + cosine * right - sine * front);
    node.v = static_cast<float>(0.5 + sine * right + cosine * front);
  }
}

BlendMap linear(const MpcdiMask& mask) {
  BlendMap map = mask.map;
  for (float& value : map.values) {
    value = std::pow(value, static_cast<float>(mask.gamma_embedded));
  }
  return map;
}

//! Returns the blend of all projectors if all have lenses and at least one of them has neither a
//! warp nor a mask.
std::optional<DomeBlend> computed_blend(const DomeSetup& setup) {
  const bool wanted = std::ranges::any_of(setup.projectors, [](const ProjectorSetup& projector) {
    return !projector.warp && projector.blend_mask.empty();
  });
  if (!wanted || !all_have_lenses(setup)) {
    return std::nullopt;
  }
  return blend_of(setup);
}

//! Returns the pixel density in a cell, for the direction in which it is largest: number of raster
//! pixels per width of the domemaster.
double finest_density(const WarpNode& corner, const WarpNode& right, const WarpNode& below, int width_px,
                      int height_px) {
  // u and v are linear functions of the raster's pixels; the smaller singular value belongs to the
  // direction in which pixels are closest.
  const double ax = width_px * static_cast<double>(right.x - corner.x);
  const double ay = height_px * static_cast<double>(right.y - corner.y);
  const double bx = width_px * static_cast<double>(below.x - corner.x);
  const double by = height_px * static_cast<double>(below.y - corner.y);
  const double area = ax * by - ay * bx;
  if (std::abs(area) < 1e-12) {
    return 0.0;
  }
  const auto slopes = [&](float at_corner, float at_right, float at_below, double& along_x, double& along_y) {
    const double a = static_cast<double>(at_right) - at_corner;
    const double b = static_cast<double>(at_below) - at_corner;
    along_x = (a * by - b * ay) / area;
    along_y = (b * ax - a * bx) / area;
  };
  double ux = 0.0;
  double uy = 0.0;
  double vx = 0.0;
  double vy = 0.0;
  slopes(corner.u, right.u, below.u, ux, uy);
  slopes(corner.v, right.v, below.v, vx, vy);
  const double sum = ux * ux + uy * uy + vx * vx + vy * vy;
  const double product = ux * vy - uy * vx;
  const double smaller = 0.5 * (sum - std::sqrt(std::max(sum * sum - 4.0 * product * product, 0.0)));
  return smaller > 0.0 ? 1.0 / std::sqrt(smaller) : 0.0;
}

}  // namespace

WarpMesh through_lens(double tilt_deg, const WarpMesh& warp, const Orientation& orientation, const Frustum& frustum) {
  const DomeScreen screen = {tilt_deg, 180.0};
  WarpMesh mesh = refined_warp(warp, steps_through_lens(warp, frustum));
  const ProjectorAxes axes = axes_of(orientation);
  for (WarpNode& node : mesh.nodes) {
    set_position(screen, direction_from_raster(axes, frustum, node.u, node.v), node);
  }
  return mesh;
}

bool all_have_lenses(const DomeSetup& setup) {
  return std::ranges::none_of(setup.projectors, [](const ProjectorSetup& projector) {
    return std::holds_alternative<std::monostate>(projector.lens);
  });
}

DomeBlend blend_of(const DomeSetup& setup) {
  std::vector<ProjectorOptics> optics;
  optics.reserve(setup.projectors.size());
  for (const ProjectorSetup& projector : setup.projectors) {
    optics.emplace_back(setup, projector);
  }
  return {std::move(optics), screen_of(setup), {}};
}

WarpMesh master_warp(const DomeSetup& setup, const ProjectorSetup& projector, const LoadedProjector& loaded,
                     double tolerance_px) {
  WarpMesh warp = unturned_warp(setup, projector, loaded, tolerance_px);
  const bool shows_master = std::ranges::any_of(warp.nodes, [](const WarpNode& node) {
    return node.valid && node.u >= 0.0F && node.u <= 1.0F && node.v >= 0.0F && node.v <= 1.0F;
  });
  if (!shows_master) {
    throw Error(location_of(projector), "has a warp that shows no part of the domemaster",
                "check that it was made for this dome, and check rows, texture and x_range");
  }
  turn(warp, one_degree * setup.rotation_deg);
  return warp;
}

std::vector<ProjectorPicture> projector_pictures(const DomeSetup& setup, double tolerance_px, MaskDetail detail) {
  if (setup.projectors.empty()) {
    throw Error("dome setup", "has no projectors", "write a [[projector]] for each projector of the dome");
  }
  const std::optional<DomeBlend> blend = computed_blend(setup);
  std::vector<ProjectorPicture> pictures;
  for (std::size_t i = 0; i < setup.projectors.size(); ++i) {
    const ProjectorSetup& projector = setup.projectors[i];
    LoadedProjector loaded = load_projector(setup, projector);
    ProjectorPicture picture;
    picture.name = projector.name;
    picture.width_px = projector.width_px;
    picture.height_px = projector.height_px;
    picture.warp = master_warp(setup, projector, loaded, tolerance_px);
    if (loaded.blend) {
      picture.blend = linear(*loaded.blend);
    } else if (blend && !projector.warp) {
      const int pixel_px = detail == MaskDetail::preview ? preview_pixel_px : 1;
      picture.blend = blend->mask(i, (projector.width_px + pixel_px - 1) / pixel_px,
                                  (projector.height_px + pixel_px - 1) / pixel_px);
    }
    picture.black_level = std::move(loaded.black_level).value_or(BlendMap{});
    picture.black_level_lift = loaded.black_level_lift;
    picture.gain = projector.gain;
    picture.gamma = projector.gamma;
    picture.notes = std::move(loaded.notes);
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

int enough_master_px(const std::vector<ProjectorPicture>& pictures) {
  std::vector<double> densities;
  for (const ProjectorPicture& picture : pictures) {
    const WarpMesh& warp = picture.warp;
    for (int row = 0; row + 1 < warp.rows; ++row) {
      for (int column = 0; column + 1 < warp.columns; ++column) {
        const WarpNode& corner = warp.at(column, row);
        const WarpNode& right = warp.at(column + 1, row);
        const WarpNode& below = warp.at(column, row + 1);
        if (corner.valid && right.valid && below.valid) {
          densities.push_back(finest_density(corner, right, below, picture.width_px, picture.height_px));
        }
      }
    }
  }
  if (densities.empty()) {
    return 256;
  }
  const auto near_finest = densities.begin() + static_cast<std::ptrdiff_t>((densities.size() - 1) * 19 / 20);
  std::ranges::nth_element(densities, near_finest);
  const double wanted = std::clamp(*near_finest, 256.0, 8192.0);
  return 64 * static_cast<int>(std::ceil(wanted / 64.0));
}

}  // namespace ergodome
