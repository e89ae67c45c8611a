#pragma once

#include "tests/support/openxr_runtime/runtime_state.h"

namespace ergodome::openxr_test {

//! Makes the program's context current, and the previous one again at the end.
class ContextScope {
 public:
  explicit ContextScope(const Session& session);
  ~ContextScope();
  ContextScope(const ContextScope&) = delete;
  ContextScope& operator=(const ContextScope&) = delete;

 private:
  Display* display_ = nullptr;
  GLXDrawable drawable_ = 0;
  GLXContext context_ = nullptr;
  bool changed_ = false;
};

//! Creates the context of the mode `changes_context`. It shares nothing with the program's context.
void create_other_context(Session& session);
void destroy_other_context(Session& session);
//! Leaves the other context current, if there is a session.
void change_context();
//! Leaves a GL error in the current context.
void leave_gl_error();

//! Creates the textures of a swapchain.
std::vector<GLuint> create_textures(const XrSwapchainCreateInfo& info, std::uint32_t count);
//! Fills an image with magenta: a program must not rely on what an earlier frame has left there.
void clear_texture(const XrSwapchainCreateInfo& info, GLuint texture);

//! Writes a rectangle of an image as PPM in sRGB, the top row first. Returns false if it cannot.
bool write_picture(const std::string& file_name, const Swapchain& swapchain, const XrSwapchainSubImage& part);

}  // namespace ergodome::openxr_test
