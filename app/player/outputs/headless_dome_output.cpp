#include "app/player/outputs/headless_dome_output.h"

#include "content/files/fingerprint.h"
#include "render/output/tone_map.h"

namespace ergodome {

namespace {

std::string fingerprint_of_image(const std::vector<std::uint8_t>& image) {
  return fingerprint({reinterpret_cast<const char*>(image.data()), image.size()});
}

}  // namespace

HeadlessDomeOutput::HeadlessDomeOutput(const std::vector<ProjectorPicture>& pictures) { set_projectors(pictures); }

void HeadlessDomeOutput::set_projectors(const std::vector<ProjectorPicture>& pictures) {
  count_ = pictures.size();
  projectors_.emplace(pictures, ProjectorDrawer::processor);
}

void HeadlessDomeOutput::show() {
  std::string all;
  for (const Picture& raster : rasters_) {
    all += fingerprint_of_image(tone_mapped(raster));
  }
  if (rasters_.empty() && !picture_.rgba.empty()) {
    projectors_->show(picture_);
    for (std::size_t i = 0; i < count_; ++i) {
      all += fingerprint_of_image(projectors_->frame(i));
    }
  }
  images_ = std::move(all);
}

std::string HeadlessDomeOutput::join_swap_group(bool joined) {
  return joined ? "there are no windows that could join a swap group; the network barrier is used" : "";
}

}  // namespace ergodome
