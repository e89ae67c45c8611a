#include "render/present/software_projectors.h"

namespace ergodome {

void SoftwareProjectors::prepare(int width, int height) {
  const LightLevel& finest = light_.levels().level[0];
  const bool resized = warps_.empty() || finest.width != width || finest.height != height;
  if (resized) {
    warps_.assign(pictures_.size(), std::nullopt);
  }
  bool changed = resized;
  LightTiles tiles(width, height);
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    if (!warps_[i]) {
      warps_[i].emplace(pictures_[i], width, height);
      changed = true;
    }
    tiles.join(warps_[i]->tiles());
  }
  if (changed) {
    tiles.complete();
    light_ = MasterLight(tiles);
  }
}

void SoftwareProjectors::show(const Picture& master, float dimmed) {
  prepare(master.width, master.height);
  light_.update(master, dimmed);
}

void SoftwareProjectors::replace(std::size_t projector, const ProjectorPicture& picture) {
  pictures_[projector] = picture;
  if (!warps_.empty()) {
    warps_[projector].reset();
  }
}

std::vector<std::uint8_t> SoftwareProjectors::frame(std::size_t projector) const {
  const ProjectorPicture& picture = pictures_[projector];
  std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(picture.width_px) *
                                static_cast<std::size_t>(picture.height_px));
  frame(projector, rgb.data());
  return rgb;
}

}  // namespace ergodome
