#pragma once

#include <cstddef>
#include <memory>

#include "render/lens/omni_lens.h"

namespace ergodome {

//! What stars are seen by: a camera, or an eye that turns with the direction one looks at, for which each direction has a camera of its own.
struct StarEye {
  StarEye(const EyeCamera& single) : camera(single) {}  // NOLINT(google-explicit-constructor): a camera is an eye
  explicit StarEye(std::shared_ptr<const OmniEye> turning) : camera(turning->head), omni(std::move(turning)) {}

  EyeCamera camera;  //!< images lie in its frame: of an eye that turns, the head with the view's axes
  std::shared_ptr<const OmniEye> omni;  //!< nothing for a camera
};

//! So many eyes a picture has.
inline constexpr std::size_t most_eyes = 2;

//! Whether one grid serves two eyes: a camera that turns or goes round the axis keeps its own.
bool served_alike(const StarEye& first, const StarEye& second);

//! Whether two eyes have the same images of all stars, in the observer's frame: one may look elsewhere.
bool sees_alike(const StarEye& first, const StarEye& second);

}  // namespace ergodome
