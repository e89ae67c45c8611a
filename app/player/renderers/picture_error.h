#pragma once

#include "app/player/renderers/frame_source.h"

namespace ergodome {

//! Returns the errors of some pixels of a picture that a renderer has just made for a request [px
//! of the whole picture]. Empty for views other than the sky, and for a picture from an earlier
//! camera position, which is late but not wrong.
std::vector<double> picture_errors(ShowRenderer& renderer, const PictureRequest& request, const Projection& projection,
                                   const ShowMoment& moment);

}  // namespace ergodome
