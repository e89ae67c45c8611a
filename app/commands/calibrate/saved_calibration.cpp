#include "app/commands/calibrate/saved_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "calibration/formats/warps/bourke_mesh.h"
#include "calibration/projectors/projector_picture.h"
#include "content/files/atomic_file.h"

namespace ergodome {

namespace {

//! Divides a mask by its maximum and multiplies the lift by it, so that their product stays the
//! same: setups limit the lift, whereas an MPCDI mask is relative to full light. Does nothing for
//! an empty or black mask.
void put_scale_into_lift(BlendMap& mask, Vector3<double>& lift) {
  const auto largest = mask.values.empty() ? mask.values.end() : std::ranges::max_element(mask.values);
  if (largest == mask.values.end() || !(*largest > 0.0F)) {
    return;
  }
  const float scale = *largest;
  lift = static_cast<double>(scale) * lift;
  for (float& value : mask.values) {
    value /= scale;
  }
}

//! Writes a mask, moved by the projector's offsets, as a 16-bit PNG in the folder of the setup.
//! Returns `name`.
std::string write_mask(const std::filesystem::path& folder, const std::string& name, const ProjectorPicture& picture,
                       const BlendMap& mask) {
  BlendMap moved = moved_mask(picture.offsets, in_shape_of(mask, picture.width_px, picture.height_px));
  moved.bit_depth = 16;
  write_text_keeping_older(folder / name, to_png(moved, name));
  return name;
}

void write_black_level(const std::filesystem::path& folder, const std::string& name, const ProjectorPicture& picture,
                       ProjectorSetup& projector) {
  // Setups limit the lift to 0.5, but that of an MPCDI calibration may be larger, because its mask
  // contains the light itself. The excess factor goes into the mask.
  constexpr double max_of_setups = 0.5;
  const Vector3<double>& lift = picture.black_level_lift;
  const double rest = std::max({1.0, lift.x / max_of_setups, lift.y / max_of_setups, lift.z / max_of_setups});
  BlendMap mask = picture.black_level;
  for (float& value : mask.values) {
    value = std::min(value * static_cast<float>(rest), 1.0F);
  }
  projector.black_level_lift = (1.0 / rest) * lift;
  projector.black_level_mask = write_mask(folder, name, picture, mask);
}

//! Throws Error unless all files that write_moved_files() writes can be written.
void require_writable_files(const std::filesystem::path& folder, const std::string& name,
                            const ProjectorPicture& picture) {
  require_writable(folder / (name + ".data"));
  if (picture.blend.width > 0) {
    require_writable(folder / (name + "_blend.png"));
  }
  if (picture.black_level.width > 0 && !picture.offsets.none()) {
    require_writable(folder / (name + "_black.png"));
  }
}

//! Writes the warp and the masks, moved by the offsets, and names them in the projector. Writes the
//! mask of the black level only if there are offsets.
void write_moved_files(const std::filesystem::path& folder, const std::string& name, const ProjectorPicture& picture,
                       ProjectorSetup& projector) {
  write_text_keeping_older(folder / (name + ".data"),
                           to_bourke_mesh(moved_warp(picture.offsets, picture.warp),
                                          static_cast<double>(picture.width_px) / picture.height_px));
  projector.warp.emplace();
  projector.warp->file = name + ".data";
  if (picture.blend.width > 0) {
    projector.blend_mask = write_mask(folder, name + "_blend.png", picture, picture.blend);
    projector.blend_mask_gamma = 1.0;
  }
  if (picture.black_level.width > 0 && !picture.offsets.none()) {
    write_black_level(folder, name + "_black.png", picture, projector);
  }
}

}  // namespace

std::string projector_file_name(std::size_t index, const std::string& name) {
  std::string plain;
  for (const char c : name) {
    plain += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' ? c : '_';
  }
  return fmt::format("{}_{}", index + 1, plain);
}

std::filesystem::path write_projector_folder(const std::filesystem::path& folder, const std::string& file_name,
                                             DomeSetup setup, const std::vector<ProjectorPicture>& pictures) {
  make_folder(folder);
  const auto write_mask = [&](const BlendMap& mask, const ProjectorPicture& of, const std::string& name) {
    if (mask.width > 0) {
      write_text_keeping_older(folder / name, to_png(in_shape_of(mask, of.width_px, of.height_px), name));
    }
    return mask.width > 0 ? name : std::string();
  };
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const ProjectorPicture& picture = pictures[i];
    ProjectorSetup& projector = setup.projectors[i];
    const std::string name = projector_file_name(i, picture.name);
    const double aspect = static_cast<double>(picture.width_px) / picture.height_px;
    write_text_keeping_older(folder / (name + ".data"), to_bourke_mesh(picture.warp, aspect));
    projector.warp.emplace();
    projector.warp->file = name + ".data";
    projector.blend_mask = write_mask(picture.blend, picture, name + "_blend.png");
    projector.blend_mask_gamma = 1.0;
    BlendMap black_level = picture.black_level;
    projector.black_level_lift = picture.black_level_lift;
    put_scale_into_lift(black_level, projector.black_level_lift);
    projector.black_level_mask = write_mask(black_level, picture, name + "_black.png");
  }
  // The meshes already contain the rotation, so the new setup has none.
  setup.rotation_deg = 0.0;
  setup.folder = folder;
  write_dome_setup(folder / file_name, setup);
  return folder / file_name;
}

DomeSetup save_calibration(const std::filesystem::path& file, const DomeSetup& setup,
                           const std::vector<GridOffsets>& offsets, const std::vector<bool>& anew) {
  DomeSetup saved = setup;
  for (ProjectorSetup& projector : saved.projectors) {
    // Later messages about this projector then name the new file.
    projector.read_from = file.string();
  }
  require_writable(file);
  const bool moved = std::ranges::any_of(offsets, [](const GridOffsets& c) { return !c.none(); });
  if (moved || std::ranges::find(anew, true) != anew.end()) {
    // The rotation stays in the setup: warps are written without it.
    DomeSetup unturned = setup;
    unturned.rotation_deg = 0.0;
    std::vector<ProjectorPicture> pictures = projector_pictures(unturned);
    const auto written = [&](std::size_t i) { return !offsets[i].none() || (i < anew.size() && anew[i]); };
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      pictures[i].offsets = offsets[i];
      if (written(i)) {
        require_writable_files(setup.folder, projector_file_name(i, pictures[i].name), pictures[i]);
      }
    }
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      if (written(i)) {
        write_moved_files(setup.folder, projector_file_name(i, pictures[i].name), pictures[i], saved.projectors[i]);
      }
    }
  }
  for (ProjectorSetup& projector : saved.projectors) {
    // A mask without a lift has no effect, and the setup reader rejects it.
    if (!(dot(projector.black_level_lift, projector.black_level_lift) > 0.0)) {
      projector.black_level_mask.clear();
    }
  }
  write_dome_setup(file, saved);
  return saved;
}

}  // namespace ergodome
