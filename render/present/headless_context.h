#pragma once

#include <memory>

namespace ergodome {

//! An OpenGL 4.5 core context without a window or a display, through EGL: on the GPU's device platform where a driver offers one, else
//! on Mesa's surfaceless platform. Current on the thread that makes it, as long as it lives.
class HeadlessContext {
 public:
  //! Throws Error when no EGL driver gives OpenGL 4.5.
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ergodome
