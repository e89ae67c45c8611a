#pragma once

#include <memory>

#include "render/present/presenter.h"

namespace ergodome {

//! A domemaster converted to display light for projectors. It is tone-mapped once for all
//! projectors, and has mipmaps so that it does not flicker where it is drawn smaller. Tone mapping
//! comes before averaging, so that one very bright star does not outshine the pixels around it.
class DisplayLight {
 public:
  //! The presenter's context must be current, as for all members except use(). Throws Error if the
  //! driver rejects the shader.
  DisplayLight();
  ~DisplayLight();
  DisplayLight(const DisplayLight&) = delete;
  DisplayLight& operator=(const DisplayLight&) = delete;

  //! Computes the light of a picture.
  void update(const PresentedPicture& picture);

  //! Binds the light (linear, 0 to 1, top row first) to a texture unit of the current context,
  //! which must share objects with the presenter's. Later commands of that context wait until the
  //! GPU has computed it. Returns false if there is no light yet.
  bool use(unsigned unit) const;

 private:
  struct State;
  void resize(int width, int height);

  std::unique_ptr<State> state_;
};

}  // namespace ergodome
