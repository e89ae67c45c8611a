#pragma once

#include "app/player/renderers/frame_source.h"

namespace ergodome {

//! What some pixels of a picture, which a renderer has just made of a request, miss on the screen [px of the whole picture]. Empty for views that
//! are not of the sky, and for a picture that is seen from where the camera was a moment ago: it is late, not wrong.
std::vector<double> picture_errors(ShowRenderer& renderer, const PictureRequest& request, const Projection& projection,
                                   const ShowMoment& moment);

}  // namespace ergodome
