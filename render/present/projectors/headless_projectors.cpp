#include "render/present/projectors/headless_projectors.h"

#include "kernels/core/error.h"
#include "render/opengl/gl_program.h"
#include "render/opengl/headless_context.h"
#include "render/present/projectors/projector_drawing.h"

namespace ergodome {

struct HeadlessProjectors::OpenGl {
  // Declared first: the context must outlive everything created in it.
  HeadlessContext context;
  Presenter presenter;
  DisplayLight light;
  std::vector<std::unique_ptr<ProjectorDrawing>> outputs;
  std::vector<std::unique_ptr<OffscreenFrame>> frames;

  explicit OpenGl(const std::vector<ProjectorPicture>& pictures) {
    for (const ProjectorPicture& picture : pictures) {
      outputs.push_back(std::make_unique<ProjectorDrawing>(picture));
      frames.push_back(std::make_unique<OffscreenFrame>(picture.width_px, picture.height_px));
    }
  }
};

namespace {

//! Returns whether OpenGL works without a display and runs on a GPU.
bool has_gpu() {
  try {
    const HeadlessContext context;
    return !draws_in_software();
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

HeadlessProjectors::HeadlessProjectors(const std::vector<ProjectorPicture>& pictures, ProjectorDrawer drawer) {
  if (drawer == ProjectorDrawer::cuda && cuda_unavailable_reason() == nullptr) {
    cuda_ = std::make_unique<SoftwareProjectors>(pictures, Backend::cuda);
  } else {
    open_without_cuda(pictures, drawer);
  }
}

void HeadlessProjectors::open_without_cuda(const std::vector<ProjectorPicture>& pictures, ProjectorDrawer drawer) {
  if (drawer == ProjectorDrawer::opengl || (drawer != ProjectorDrawer::processor && has_gpu())) {
    opengl_ = std::make_unique<OpenGl>(pictures);
  } else {
    software_ = std::make_unique<SoftwareProjectors>(pictures);
  }
}

HeadlessProjectors::~HeadlessProjectors() = default;

bool HeadlessProjectors::show_by_cuda(const Picture& master) {
  if (!cuda_) {
    return false;
  }
  try {
    cuda_->show(master);
    cuda_->draw_in_place();
    return true;
  } catch (const Error&) {
    const std::vector<ProjectorPicture> pictures = cuda_->pictures();
    cuda_.reset();
    open_without_cuda(pictures, ProjectorDrawer::automatic);
    return false;
  }
}

void HeadlessProjectors::show(const Picture& master) {
  if (show_by_cuda(master)) {
    return;
  }
  if (software_) {
    return software_->show(master);
  }
  opengl_->presenter.upload(master);
  opengl_->light.update(opengl_->presenter.shown());
}

std::vector<std::uint8_t> HeadlessProjectors::frame(std::size_t projector) {
  if (cuda_) {
    return cuda_->read_raster(projector);
  }
  if (software_) {
    return software_->frame(projector);
  }
  const OffscreenFrame& frame = *opengl_->frames[projector];
  frame.bind();
  opengl_->outputs[projector]->draw(opengl_->light, frame.width(), frame.height());
  return frame.read_back();
}

}  // namespace ergodome
