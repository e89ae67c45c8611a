#include "calibration/projectors/dome_pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/projectors/dome_blend.h"
#include "calibration/projectors/dome_warp.h"
#include "calibration/projectors/projector_picture.h"

namespace ergodome {

namespace {

//! Maximum error of the nodes of a warp that counts as computed, in widths of the domemaster: half
//! a pixel of a 4096-pixel domemaster. Rounding errors in files are far smaller.
constexpr double node_tolerance = 1.2e-4;
//! Maximum error of the values of a mask that counts as computed: one step of 8 bits.
constexpr double mask_tolerance = 1.0 / 255.0;
//! Number of compared pixels per side of a mask.
constexpr int mask_samples = 48;

//! Returns true if a warp has nodes on the dome, and each of these has the position in the
//! domemaster that the projector's light meets.
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
    if (!point || !master_position_near_rim(screen, *point, u, v) ||
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

std::vector<LoadedProjector> all_loaded(const DomeSetup& setup) {
  std::vector<LoadedProjector> files;
  files.reserve(setup.projectors.size());
  for (const ProjectorSetup& projector : setup.projectors) {
    files.push_back(load_projector(setup, projector));
  }
  return files;
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

DomePictures::DomePictures(DomeSetup setup, MaskDetail detail)
    : read_(std::move(setup)),
      files_(all_loaded(read_)),
      pictures_(projector_pictures(read_, computed_tolerance_px, detail)),
      tilt_deg_(read_.tilt_deg),
      rotation_deg_(read_.rotation_deg) {
  without_ = without_computed_files(read_, files_);
  bool any = false;
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    if (read_.projectors[i].warp && !without_.projectors[i].warp) {
      files_[i].warp = std::monostate{};
    }
    masks_.push_back(has_computed_mask(i) ? pictures_[i].blend : BlendMap{});
    // Masks that were read from files are never previews, even if they count as computed.
    coarse_.push_back(detail == MaskDetail::preview && has_computed_mask(i) && read_.projectors[i].blend_mask.empty() &&
                      !read_.projectors[i].warp);
    any = any || has_computed_mask(i);
  }
  if (any) {
    blend_ = blend_of(read_);
  }
}

bool DomePictures::has_computed_mask(std::size_t projector) const {
  // If a projector lacks a lens, no mask is computed, and `blend` has width 0.
  const ProjectorSetup& files = without_.projectors[projector];
  return !files.warp && files.blend_mask.empty() && pictures_[projector].blend.width > 0;
}

std::vector<BlendMap> DomePictures::masks_at_tilt(const DomeSetup& setup) const {
  const DomeBlend now = blend_of(setup);
  std::vector<BlendMap> masks(masks_.size());
  for (std::size_t i = 0; i < masks_.size(); ++i) {
    if (masks_[i].width > 0) {
      masks[i] = now.mask_after_tilt(i, masks_[i], *blend_);
    }
  }
  return masks;
}

bool DomePictures::follow(const DomeSetup& setup, const std::vector<GridOffsets>& offsets) {
  const bool turned = setup.tilt_deg != tilt_deg_ || setup.rotation_deg != rotation_deg_;
  std::vector<WarpMesh> warps;
  for (std::size_t i = 0; turned && i < pictures_.size(); ++i) {
    warps.push_back(master_warp(setup, setup.projectors[i], files_[i]));
  }
  const bool renews_masks = blend_ && setup.tilt_deg != tilt_deg_;
  std::vector<BlendMap> masks = renews_masks ? masks_at_tilt(setup) : std::vector<BlendMap>{};
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    ProjectorPicture& picture = pictures_[i];
    const ProjectorSetup& projector = setup.projectors[i];
    if (turned) {
      picture.warp = std::move(warps[i]);
    }
    picture.offsets = offsets[i];
    picture.gain = projector.gain;
    picture.gamma = projector.gamma;
    const Vector3<double>& lift = projector.black_level_lift;
    picture.black_level_lift = dot(lift, lift) > 0.0 ? lift : files_[i].black_level_lift;
    if (renews_masks && masks[i].width > 0) {
      picture.blend = std::move(masks[i]);
    }
  }
  tilt_deg_ = setup.tilt_deg;
  rotation_deg_ = setup.rotation_deg;
  return renews_masks;
}

std::optional<std::size_t> DomePictures::refine_mask() {
  const auto found = std::ranges::find(coarse_, true);
  if (found == coarse_.end()) {
    return std::nullopt;
  }
  *found = false;
  const auto i = static_cast<std::size_t>(found - coarse_.begin());
  ProjectorPicture& picture = pictures_[i];
  masks_[i] = blend_->mask(i, picture.width_px, picture.height_px);
  picture.blend = masks_[i];
  if (tilt_deg_ != read_.tilt_deg) {
    DomeSetup shown = read_;
    shown.tilt_deg = tilt_deg_;
    picture.blend = blend_of(shown).mask_after_tilt(i, masks_[i], *blend_);
  }
  return i;
}

bool DomePictures::leaves_behind(const DomeSetup& setup) const {
  if (setup.tilt_deg == read_.tilt_deg) {
    return false;
  }
  for (std::size_t i = 0; i < files_.size(); ++i) {
    // Surfaces and warps of a lens image are mapped to the domemaster with the current tilt, so
    // they follow a new tilt; only flat warps of the domemaster do not.
    const bool flat = std::holds_alternative<WarpMesh>(files_[i].warp) && files_[i].source == WarpSource::dome_picture;
    if (flat) {
      return true;
    }
  }
  return false;
}

std::vector<bool> DomePictures::outdated(const DomeSetup& setup) const {
  std::vector<bool> projectors;
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const bool computed = read_.projectors[i].warp && !without_.projectors[i].warp;
    projectors.push_back(computed && setup.tilt_deg != read_.tilt_deg);
  }
  return projectors;
}

DomeSetup DomePictures::without_outdated(const DomeSetup& setup) const {
  DomeSetup without = setup;
  const std::vector<bool> old = outdated(setup);
  for (std::size_t i = 0; i < old.size(); ++i) {
    if (old[i]) {
      without.projectors[i].warp = without_.projectors[i].warp;
      without.projectors[i].blend_mask = without_.projectors[i].blend_mask;
    }
  }
  return without;
}

}  // namespace ergodome
