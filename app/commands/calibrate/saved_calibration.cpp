#include "app/commands/calibrate/saved_calibration.h"

#include <algorithm>

#include "app/commands/calibrate/projector_folder.h"
#include "calibration/formats/warps/bourke_mesh.h"
#include "calibration/projectors/projector_picture.h"
#include "content/files/atomic_file.h"

namespace ergodome {

namespace {

//! Writes a mask, moved by the projector's offsets, as a PNG in the folder of the setup. Returns
//! its name.
std::string write_mask(const std::filesystem::path& folder, const std::string& name, const ProjectorPicture& picture,
                       const BlendMap& mask) {
  BlendMap moved = moved_mask(picture.offsets, in_shape_of(mask, picture.width_px, picture.height_px));
  moved.bit_depth = 16;
  write_text_keeping_older(folder / name, to_png(moved, name));
  return name;
}

void write_black_level(const std::filesystem::path& folder, const std::string& name, const ProjectorPicture& picture,
                       ProjectorSetup& projector) {
  // The mask of an MPCDI calibration contains the light itself, but setups limit the lift to 0.5:
  // the remaining factor goes into the mask.
  constexpr double most_of_setups = 0.5;
  const Vector3<double>& lift = picture.black_level_lift;
  const double rest = std::max({1.0, lift.x / most_of_setups, lift.y / most_of_setups, lift.z / most_of_setups});
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

//! Writes the warp and the masks, moved by the offsets, and names them in the projector.
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

DomeSetup save_calibration(const std::filesystem::path& file, const DomeSetup& setup,
                           const std::vector<GridOffsets>& offsets, const std::vector<bool>& anew) {
  DomeSetup saved = setup;
  for (ProjectorSetup& projector : saved.projectors) {
    // Messages then refer to the new file.
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
