#include "render/opengl/headless_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "kernels/core/error.h"

namespace ergodome {

struct HeadlessContext::State {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

namespace {

EGLContext make_context(EGLDisplay display) {
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE ||
      eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) {
    return EGL_NO_CONTEXT;
  }
  const EGLint config_wish[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  const bool chosen = eglChooseConfig(display, config_wish, &config, 1, &count) == EGL_TRUE && count > 0;
  const EGLint context_wish[] = {
      EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  const EGLContext context = chosen ? eglCreateContext(display, config, EGL_NO_CONTEXT, context_wish) : EGL_NO_CONTEXT;
  if (context == EGL_NO_CONTEXT || eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
    if (context != EGL_NO_CONTEXT) {
      eglDestroyContext(display, context);
    }
    eglTerminate(display);
    return EGL_NO_CONTEXT;
  }
  return context;
}

//! Returns the displays to try, in order of preference: every device that a driver lists, then
//! Mesa's surfaceless platform.
std::vector<EGLDisplay> candidate_displays() {
  std::vector<EGLDisplay> displays;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
      epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
    EGLDeviceEXT devices[16];
    EGLint count = 0;
    if (eglQueryDevicesEXT(16, devices, &count) == EGL_TRUE) {
      for (EGLint i = 0; i < count; ++i) {
        displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
      }
    }
  }
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  }
  return displays;
}

}  // namespace

HeadlessContext::HeadlessContext() : state_(std::make_unique<State>()) {
  for (const EGLDisplay display : candidate_displays()) {
    state_->context = make_context(display);
    if (state_->context != EGL_NO_CONTEXT) {
      state_->display = display;
      return;
    }
  }
  throw Error("EGL", "no graphics driver offers OpenGL 4.5 without a display",
              "install libegl-mesa0 and libgl1-mesa-dri");
}

HeadlessContext::~HeadlessContext() {
  eglMakeCurrent(state_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(state_->display, state_->context);
  eglTerminate(state_->display);
}

std::vector<std::uint8_t> read_framebuffer(int width, int height) {
  const std::size_t row = 3 * static_cast<std::size_t>(width);
  std::vector<std::uint8_t> bottom_up(row * static_cast<std::size_t>(height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, bottom_up.data());
  std::vector<std::uint8_t> top_down(bottom_up.size());
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    std::copy_n(bottom_up.begin() + static_cast<long>(y * row), row,
                top_down.begin() + static_cast<long>((static_cast<std::size_t>(height) - 1 - y) * row));
  }
  return top_down;
}

OffscreenFrame::OffscreenFrame(int width, int height) : width_(width), height_(height) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (width > largest || height > largest) {
    throw Error("OpenGL", fmt::format("the graphics driver cannot draw a picture of {} x {} pixels", width, height),
                fmt::format("use at most {} pixels a side", largest));
  }
  glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
  glTextureStorage2D(texture_, 1, GL_RGBA8, width, height);
  glCreateFramebuffers(1, &framebuffer_);
  glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture_, 0);
  if (glCheckNamedFramebufferStatus(framebuffer_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(1, &texture_);
    throw Error(
        "OpenGL",
        fmt::format("the graphics driver cannot allocate memory for a picture of {} x {} pixels", width, height),
        "choose a smaller resolution");
  }
}

OffscreenFrame::~OffscreenFrame() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &texture_);
}

void OffscreenFrame::bind() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_); }

std::vector<std::uint8_t> OffscreenFrame::read_back() const {
  bind();
  return read_framebuffer(width_, height_);
}

}  // namespace ergodome
