#include "render/passes/objects/polygons/object_target.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "kernels/core/error.h"
#include "kernels/launch/work_counter.h"

namespace ergodome {

ObjectTarget::ObjectTarget(int width, int height) : width_(width), height_(height) {
  count_work("buffer: objects' picture", bytes_for(width, height));
  glCreateRenderbuffers(1, &light_);
  glNamedRenderbufferStorageMultisample(light_, samples, GL_RGBA16F, width, height);
  glCreateRenderbuffers(1, &depth_);
  glNamedRenderbufferStorageMultisample(depth_, samples, GL_DEPTH_COMPONENT32F, width, height);
  glCreateRenderbuffers(1, &resolved_);
  glNamedRenderbufferStorage(resolved_, GL_RGBA16F, width, height);
  glCreateFramebuffers(1, &framebuffer_);
  glNamedFramebufferRenderbuffer(framebuffer_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, light_);
  glNamedFramebufferRenderbuffer(framebuffer_, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
  glCreateFramebuffers(1, &resolved_framebuffer_);
  glNamedFramebufferRenderbuffer(resolved_framebuffer_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, resolved_);
  if (glCheckNamedFramebufferStatus(framebuffer_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE ||
      glCheckNamedFramebufferStatus(resolved_framebuffer_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw Error("OpenGL",
                fmt::format("the graphics driver cannot allocate memory for objects in a picture of {} x {} pixels",
                            width, height),
                "choose a smaller picture");
  }
}

ObjectTarget::~ObjectTarget() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteFramebuffers(1, &resolved_framebuffer_);
  glDeleteRenderbuffers(1, &light_);
  glDeleteRenderbuffers(1, &depth_);
  glDeleteRenderbuffers(1, &resolved_);
}

void ObjectTarget::begin() const {
  constexpr float nothing[4] = {0.0F, 0.0F, 0.0F, 0.0F};
  constexpr float farthest = 1.0F;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glDepthMask(GL_TRUE);
  glClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, nothing);
  glClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &farthest);
}

void ObjectTarget::read(std::vector<float>& rgba) const {
  rgba.resize(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  glBlitNamedFramebuffer(framebuffer_, resolved_framebuffer_, 0, 0, width_, height_, 0, 0, width_, height_,
                         GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_framebuffer_);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, rgba.data());
}

}  // namespace ergodome
