#include "app/commands/calibrate/projector_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "calibration/formats/warps/bourke_mesh.h"
#include "content/files/atomic_file.h"

namespace ergodome {

namespace {

//! Scales a mask so that its maximum is 1, and reduces the lift by the same factor: setups limit
//! the lift, whereas an MPCDI mask is relative to full light.
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
  // The meshes already contain the rotation.
  setup.rotation_deg = 0.0;
  setup.folder = folder;
  write_dome_setup(folder / file_name, setup);
  return folder / file_name;
}

}  // namespace ergodome
