#include "render/present/projectors/software_projectors.h"

namespace ergodome {

bool SoftwareProjectors::has_other_warps(int width, int height) const {
  const LightLevel& finest = light_.levels().level[0];
  return !warps_.empty() && (finest.width != width || finest.height != height);
}

void SoftwareProjectors::prepare(int width, int height) {
  const bool resized = warps_.empty() || has_other_warps(width, height);
  if (resized) {
    warps_.clear();
    warps_.resize(pictures_.size());
  }
  bool changed = resized;
  LightTiles tiles(width, height);
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    if (!warps_[i]) {
      warps_[i].emplace(pictures_[i], width, height, backend_);
      changed = true;
    }
    tiles.join(warps_[i]->tiles());
  }
  if (changed) {
    tiles.complete();
    light_ = MasterLight(tiles, backend_);
  }
}

void SoftwareProjectors::show(const Picture& master) {
  MasterPicture there = master_picture(master);
  if (backend_ == Backend::cuda) {
    // Waits because the GPU may still be reading the last domemaster.
    wait_for_device(backend_);
    reserve(backend_, master.rgba.size(), "projectors' master", master_);
    master_.write(master.rgba.data(), master.rgba.size());
    there.rgba = master_.data();
  }
  show_in_place(there);
}

void SoftwareProjectors::show_in_place(const MasterPicture& master) {
  prepare(master.width, master.height);
  light_.update(master);
}

void SoftwareProjectors::replace(std::size_t projector, const ProjectorPicture& picture) {
  pictures_[projector] = picture;
  if (!warps_.empty()) {
    warps_[projector].reset();
  }
}

std::size_t SoftwareProjectors::raster_bytes(std::size_t projector) const {
  const ProjectorPicture& picture = pictures_[projector];
  return 3 * static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(picture.height_px);
}

std::vector<std::uint8_t> SoftwareProjectors::frame(std::size_t projector) {
  std::vector<std::uint8_t> rgb(raster_bytes(projector));
  frame(projector, rgb.data());
  return rgb;
}

void SoftwareProjectors::frame(std::size_t projector, std::uint8_t* rgb) {
  if (backend_ == Backend::cpu) {
    return warps_[projector]->draw(light_.levels(), shown_light_, rgb);
  }
  draw_raster(projector);
  wait_for_device(backend_);
  rasters_[projector].read(rgb, raster_bytes(projector));
}

void SoftwareProjectors::draw_raster(std::size_t projector) {
  const std::size_t bytes = raster_bytes(projector);
  if (rasters_[projector].size() != bytes) {
    rasters_[projector] = Buffer<std::uint8_t>(backend_, bytes, "projector's raster");
  }
  warps_[projector]->draw(light_.levels(), shown_light_, rasters_[projector].data());
}

void SoftwareProjectors::draw_in_place() {
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    draw_raster(i);
  }
  wait_for_device(backend_);
}

std::vector<std::uint8_t> SoftwareProjectors::read_raster(std::size_t projector) const {
  std::vector<std::uint8_t> rgb(raster_bytes(projector));
  rasters_[projector].read(rgb.data(), rgb.size());
  return rgb;
}

}  // namespace ergodome
