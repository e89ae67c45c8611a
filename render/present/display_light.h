#pragma once

#include <memory>

#include "render/present/presenter.h"

namespace ergodome {

//! A domemaster as light for projectors: toned once for all of them, and with its averages over wider and wider pixels, so that what is
//! drawn small does not flicker. The tone comes before the averages: one very bright star fills its own pixels, not those around it.
class DisplayLight {
 public:
  //! Needs the presenter's context current, as all of it but use() does. Throws Error when the driver refuses the shader.
  DisplayLight();
  ~DisplayLight();
  DisplayLight(const DisplayLight&) = delete;
  DisplayLight& operator=(const DisplayLight&) = delete;

  //! Makes the light of a picture.
  void update(const PresentedPicture& picture);

  //! Binds the light (linear, 0 to 1, its first row the top) to a texture unit of the current context, which shares the presenter's, once
  //! the GPU has made it. False while there is none.
  bool use(unsigned unit) const;

 private:
  struct State;
  void resize(int width, int height);

  std::unique_ptr<State> state_;
};

}  // namespace ergodome
