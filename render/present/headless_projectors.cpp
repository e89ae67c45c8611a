#include "render/present/headless_projectors.h"

#include "render/present/headless_context.h"
#include "render/present/offscreen_frame.h"
#include "render/present/projector_drawing.h"

namespace ergodome {

struct HeadlessProjectors::State {
  // The context outlives all that was made in it.
  HeadlessContext context;
  Presenter presenter;
  DisplayLight light;
  std::vector<std::unique_ptr<ProjectorDrawing>> outputs;
  std::vector<std::unique_ptr<OffscreenFrame>> frames;
};

HeadlessProjectors::HeadlessProjectors(const std::vector<ProjectorPicture>& pictures)
    : state_(std::make_unique<State>()) {
  for (const ProjectorPicture& picture : pictures) {
    state_->outputs.push_back(std::make_unique<ProjectorDrawing>(picture));
    state_->frames.push_back(std::make_unique<OffscreenFrame>(picture.width_px, picture.height_px));
  }
}

HeadlessProjectors::~HeadlessProjectors() = default;

void HeadlessProjectors::show(const Picture& master) {
  state_->presenter.upload(master);
  state_->light.update(state_->presenter.shown());
}

std::vector<std::uint8_t> HeadlessProjectors::frame(std::size_t projector) {
  const OffscreenFrame& frame = *state_->frames[projector];
  frame.bind();
  state_->outputs[projector]->draw(state_->light, frame.width(), frame.height());
  return frame.read_back();
}

}  // namespace ergodome
