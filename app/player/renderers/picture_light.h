#pragma once

#include "app/player/renderers/frame_source.h"

namespace ergodome {

//! Returns the fraction of a picture's pixels that are brighter than a display's black, 0 to 1.
double lit_part(const Picture& picture, const Tone& tone);

//! Renders the view of a request at a small size, for one eye, with the show's exposure and without
//! captions, and returns its lit_part(). The renderer must be set up for the request. Invalidates
//! pictures in device memory.
double lit_part_of_view(ShowRenderer& renderer, const PictureRequest& request, const ShowMoment& moment);

}  // namespace ergodome
