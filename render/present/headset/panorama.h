#pragma once

#include <glm/gtc/quaternion.hpp>
#include <memory>

#include "render/picture/picture.h"
#include "render/present/output.h"

namespace ergodome {

//! Stars of an eye's panorama in OpenGL.
struct PanoramaStars {
  unsigned buffer = 0;  //!< of StarLight
  int count = 0;
  double sigma_px = 0.0;   //!< as in StarLights
  double cutoff_px = 0.0;  //!< as in StarLights
};

//! The whole lensed sky of one camera position in OpenGL, for one or two eyes. Views in any
//! direction are drawn from it, so a head can turn without a new picture.
class Panorama {
 public:
  //! Uses the current OpenGL context.
  Panorama();
  ~Panorama();
  Panorama(const Panorama&) = delete;
  Panorama& operator=(const Panorama&) = delete;

  //! Replaces the panorama by a frame whose pictures are strips of the six faces of a cube
  //! (kernels/projection/cube_faces.h). Throws Error if they are not, or if CUDA fails.
  void set(const OutputFrame& frame);

  [[nodiscard]] bool empty() const;
  //! Binds an eye's cube map to a texture unit: 0 is the left eye. A panorama of one eye serves
  //! both.
  void use(int eye, unsigned unit) const;
  //! Returns the stars that are to be drawn over an eye's cube map, whose fourth channel is then the
  //! opacity of what covers them; nullptr without stars.
  [[nodiscard]] const PanoramaStars* stars(int eye) const;
  [[nodiscard]] const Tone& tone() const;
  [[nodiscard]] bool heat_map() const;
  //! Returns the rotation of the pictures' axes into the level axes of the observer.
  [[nodiscard]] const glm::dquat& turn() const;
  [[nodiscard]] int face_px() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ergodome
