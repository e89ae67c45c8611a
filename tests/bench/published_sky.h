#pragma once

#include "content/show/show.h"

namespace ergodome {

//! Returns a show with the setup of table 1 in Verbraeck & Eisemann: a fast-spinning hole seen from
//! 5 M, an equirectangular picture of 1920 x 960 px, redshift, lensing, diffraction, the 5,047
//! brightest stars, and a map of 4096 x 2048 texels, resampled from the built-in one. Writes the
//! map and the star catalogue to the folder for temporary files.
Show published_show();

}  // namespace ergodome
