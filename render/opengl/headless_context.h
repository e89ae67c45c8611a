#pragma once

#include <memory>

namespace ergodome {

//! An OpenGL 4.5 core context without a window or a display, through EGL: on the device platform of
//! a GPU driver if there is one, otherwise on Mesa's surfaceless platform. Current on the thread
//! that creates it, while it exists.
class HeadlessContext {
 public:
  //! Throws Error if no EGL driver offers OpenGL 4.5.
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ergodome
