#include "tests/support/openxr_runtime/runtime_gl.h"

#include <array>

namespace ergodome::openxr_test {

ContextScope::ContextScope(const Session& session)
    : display_(session.binding.xDisplay), drawable_(glXGetCurrentDrawable()), context_(glXGetCurrentContext()) {
  if (context_ != session.binding.glxContext) {
    changed_ = true;
    glXMakeCurrent(display_, session.binding.glxDrawable, session.binding.glxContext);
  }
}

ContextScope::~ContextScope() {
  if (changed_) {
    glXMakeCurrent(display_, drawable_, context_);
  }
}

void create_other_context(Session& session) {
  Display* const display = session.binding.xDisplay;
  int config_id = 0;
  int screen = 0;
  glXQueryContext(display, session.binding.glxContext, GLX_FBCONFIG_ID, &config_id);
  glXQueryContext(display, session.binding.glxContext, GLX_SCREEN, &screen);
  const std::array<int, 3> wanted = {GLX_FBCONFIG_ID, config_id, 0};
  int count = 0;
  GLXFBConfig* const configs = glXChooseFBConfig(display, screen, wanted.data(), &count);
  if (configs != nullptr && count > 0) {
    session.other_context = glXCreateNewContext(display, configs[0], GLX_RGBA_TYPE, nullptr, 1);
  }
  if (configs != nullptr) {
    XFree(static_cast<void*>(configs));
  }
  if (session.other_context == nullptr) {
    runtime_log().note("no_other_context", "the mode changes_context has no effect");
  }
}

void destroy_other_context(Session& session) {
  if (session.other_context == nullptr) {
    return;
  }
  if (glXGetCurrentContext() == session.other_context) {
    glXMakeCurrent(session.binding.xDisplay, 0, nullptr);
  }
  glXDestroyContext(session.binding.xDisplay, session.other_context);
  session.other_context = nullptr;
}

void change_context() {
  for (const auto& [handle, session] : runtime().sessions) {
    if (session.other_context != nullptr) {
      glXMakeCurrent(session.binding.xDisplay, session.binding.glxDrawable, session.other_context);
    }
  }
}

void leave_gl_error() {
  if (glXGetCurrentContext() != nullptr) {
    glEnable(0xDEAD);
  }
}

std::vector<GLuint> create_textures(const XrSwapchainCreateInfo& info, std::uint32_t count) {
  const bool is_array = info.arraySize > 1;
  const GLenum target = is_array ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
  GLint bound = 0;
  glGetIntegerv(is_array ? GL_TEXTURE_BINDING_2D_ARRAY : GL_TEXTURE_BINDING_2D, &bound);
  std::vector<GLuint> textures(count);
  glGenTextures(static_cast<GLsizei>(count), textures.data());
  const auto levels = static_cast<GLsizei>(info.mipCount);
  const auto format = static_cast<GLenum>(info.format);
  const auto width = static_cast<GLsizei>(info.width);
  const auto height = static_cast<GLsizei>(info.height);
  for (const GLuint texture : textures) {
    glBindTexture(target, texture);
    if (is_array) {
      glTexStorage3D(target, levels, format, width, height, static_cast<GLsizei>(info.arraySize));
    } else {
      glTexStorage2D(target, levels, format, width, height);
    }
  }
  glBindTexture(target, static_cast<GLuint>(bound));
  return textures;
}

void clear_texture(const XrSwapchainCreateInfo& info, GLuint texture) {
  const bool is_depth = info.format == GL_DEPTH_COMPONENT32F || info.format == GL_DEPTH24_STENCIL8;
  if (!is_depth && epoxy_has_gl_extension("GL_ARB_clear_texture")) {
    const std::array<std::uint8_t, 4> magenta = {255, 0, 255, 255};
    glClearTexImage(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, magenta.data());
  }
}

}  // namespace ergodome::openxr_test
