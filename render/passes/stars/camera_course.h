#pragma once

#include "render/passes/eye_picture.h"
#include "render/passes/stars/search/star_finder.h"

namespace ergodome {

//! Returns the course of a picture's camera. On a show's path, whether it is slow depends only on the
//! show and the time, so that a picture does not depend on which pictures were rendered before.
//! Elsewhere it depends on ShowMoment::before.
CameraCourse course_of(const EyePicture& picture);

}  // namespace ergodome
