#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>
#include <memory>

#include "render/present/headset/panorama.h"

namespace ergodome {

//! Draws views of a panorama whose stars are apart, in linear light: the stars are points of the
//! view's own pixels, dimmed by what covers the sky.
class StarView {
 public:
  //! Uses the current OpenGL 4.5 context. Throws Error if the driver rejects a shader.
  StarView();
  ~StarView();
  StarView(const StarView&) = delete;
  StarView& operator=(const StarView&) = delete;

  //! Draws a view into a texture and returns the texture, which is valid until the next call.
  //! `sky_from_eye`: rotation of the view's axes into those of the panorama's pictures; `tangents`:
  //! of the view's left, right, lower and upper side. The eye must have stars
  //! (Panorama::stars()). Does not change the bound framebuffer.
  unsigned draw(const Panorama& panorama, int eye, const glm::mat3& sky_from_eye, const glm::vec4& tangents,
                ImageSize size);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ergodome
