#include "app/player/outputs/dome_output.h"

#include <algorithm>
#include <utility>

#include "app/cli/setup_show.h"

namespace ergodome {

namespace {

//! Returns the options of the control window with a smaller limit of its initial size, so that it
//! fits beside the projectors' windows.
WindowOptions beside_projectors(WindowOptions window) {
  window.largest = {700, 700};
  return window;
}

}  // namespace

void keep_projectors_of(ProjectorOptions& projectors, const std::string& node) {
  std::vector<ProjectorPicture> kept;
  for (std::size_t i = 0; i < projectors.pictures.size(); ++i) {
    if (projectors.setup.projectors[i].node == node) {
      kept.push_back(std::move(projectors.pictures[i]));
    }
  }
  projectors.pictures = std::move(kept);
  projectors.setup = part_of_setup(projectors.setup, node);
}

DomeOutput::DomeOutput(const WindowOptions& window, const ProjectorOptions& projectors)
    : WindowOutput(beside_projectors(window)),
      names_(plain_names(projectors.setup)),
      master_px_(projectors.master_px),
      projectors_(this->window(), projectors.setup, projectors.pictures, projectors.hide_control) {}

OutputWish DomeOutput::wish() {
  OutputWish wish;
  wish.projectors_px = master_px_;
  return wish;
}

void DomeOutput::take(OutputFrame& frame) {
  WindowOutput::take(frame);
  projectors_.take(frame.on_device ? &*frame.on_device : nullptr);
  projectors_.lay_over(frame.captions);
}

void DomeOutput::show() {
  projectors_.show(shown());
  if (projectors_.control_shown()) {
    WindowOutput::show();
  }
}

std::vector<WindowEvent> DomeOutput::events() {
  std::vector<WindowEvent> all = WindowOutput::events();
  const std::vector<WindowEvent> others = projectors_.events();
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

void DomeOutput::set_projectors(const std::vector<ProjectorPicture>& pictures) {
  for (std::size_t i = 0; i < std::min(pictures.size(), names_.size()); ++i) {
    projectors_.replace(i, pictures[i]);
  }
}

void DomeOutput::set_rasters(const std::vector<Picture>& rasters) {
  for (std::size_t i = 0; i < names_.size(); ++i) {
    projectors_.set_raster(i, i < rasters.size() ? &rasters[i] : nullptr);
  }
}

void DomeOutput::set_projector_texts(const std::vector<std::string>& texts) {
  for (std::size_t i = 0; i < names_.size(); ++i) {
    projectors_.set_text(i, i < texts.size() ? texts[i] : std::string());
  }
}

void DomeOutput::save_screenshot(const std::string& file) {
  projectors_.save_screenshots(file, names_);
  WindowOutput::save_screenshot(file);
}

}  // namespace ergodome
