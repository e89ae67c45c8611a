#pragma once

#include "content/show/show.h"

namespace ergodome {

//! The set-up of Verbraeck & Eisemann's table 1: a fast hole from five M, a whole sky of 1920 x 960 px, redshift, lensing, diffraction, the 5,047 brightest
//! stars, and a map of 4096 x 2048 texels, which the built-in one is spread to. Writes both into the folder for temporary files.
Show published_show();

}  // namespace ergodome
