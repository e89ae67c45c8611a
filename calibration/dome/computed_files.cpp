#include "calibration/dome/computed_files.h"

#include <algorithm>
#include <cmath>

#include "calibration/dome/dome_blend.h"
#include "calibration/dome/dome_warp.h"
#include "calibration/projectors/projector_picture.h"

namespace ergodome {

namespace {

//! Maximum error of a computed node, in widths of the master: half a pixel of a 4096-pixel master.
//! Files round to far less.
constexpr double node_tolerance = 1.2e-4;
//! Maximum error of a computed mask's value: one step of 8 bits.
constexpr double mask_tolerance = 1.0 / 255.0;
//! Number of compared pixels per side of a mask.
constexpr int mask_samples = 48;

//! Returns true if all of a warp's nodes on the dome are where the projector's light meets the
//! domemaster.
bool is_computed_warp(const ProjectorOptics& optics, const DomeScreen& screen, const WarpMesh& warp) {
  bool any = false;
  for (const WarpNode& node : warp.nodes) {
    const bool on_dome = std::hypot(node.u - 0.5F, node.v - 0.5F) <= 0.5F;
    if (!node.valid || !on_dome) {
      continue;
    }
    const auto point = optics.dome_point({static_cast<double>(node.x), static_cast<double>(node.y)});
    double u = 0.0;
    double v = 0.0;
    if (!point || !master_place_near_rim(screen, *point, u, v) ||
        std::hypot(u - static_cast<double>(node.u), v - static_cast<double>(node.v)) > node_tolerance) {
      return false;
    }
    any = true;
  }
  return any;
}

bool is_computed_mask(const DomeBlend& blend, std::size_t projector, const MpcdiMask& mask) {
  const BlendMap& map = mask.map;
  if (map.channels != 1) {
    return false;
  }
  for (int i = 0; i < mask_samples * mask_samples; ++i) {
    const int column = (i % mask_samples) * (map.width - 1) / (mask_samples - 1);
    const int row = (i / mask_samples) * (map.height - 1) / (mask_samples - 1);
    const float value = map.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                                   static_cast<std::size_t>(column)];
    const double wanted =
        blend.intensity(projector, {fill_position(column, map.width), fill_position(row, map.height)});
    if (std::abs(std::pow(static_cast<double>(value), mask.gamma_embedded) - wanted) > mask_tolerance) {
      return false;
    }
  }
  return true;
}

}  // namespace

DomeSetup without_computed_files(const DomeSetup& setup, const std::vector<LoadedProjector>& loaded) {
  DomeSetup without = setup;
  if (!all_have_lenses(setup)) {
    return without;
  }
  const DomeScreen screen = {setup.tilt_deg, 180.0};
  std::vector<ProjectorOptics> optics;
  optics.reserve(setup.projectors.size());
  std::vector<bool> computed;
  for (std::size_t i = 0; i < setup.projectors.size(); ++i) {
    const ProjectorSetup& projector = setup.projectors[i];
    optics.emplace_back(setup, projector);
    const auto* const warp = std::get_if<WarpMesh>(&loaded[i].warp);
    computed.push_back(warp != nullptr && loaded[i].source == WarpSource::dome_picture &&
                       projector.black_level_mask.empty() == !loaded[i].black_level && !projector.blend_mask.empty() &&
                       is_computed_warp(optics[i], screen, *warp));
  }
  if (std::ranges::find(computed, true) == computed.end()) {
    return without;
  }
  const DomeBlend blend(optics, screen, {});
  for (std::size_t i = 0; i < computed.size(); ++i) {
    ProjectorSetup& projector = without.projectors[i];
    if (computed[i]) {
      projector.warp.reset();
      projector.blend_mask = is_computed_mask(blend, i, *loaded[i].blend) ? "" : projector.blend_mask;
    }
  }
  return without;
}

}  // namespace ergodome
