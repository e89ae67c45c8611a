#pragma once

#include "app/player/renderers/frame_source.h"

namespace ergodome {

//! Returns the part of a picture's pixels that are brighter than a display's black, 0 to 1.
double lit_part(const Picture& picture, const Tone& tone);

//! Renders the view of a request small, for one eye, with the show's own exposure and without captions, and returns lit_part() of it. The renderer
//! is set up for the request already; pictures that it left in a device's memory are lost.
double lit_part_of_view(ShowRenderer& renderer, const PictureRequest& request, const ShowMoment& moment);

}  // namespace ergodome
