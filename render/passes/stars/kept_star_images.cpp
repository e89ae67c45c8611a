#include "render/passes/stars/kept_star_images.h"

namespace ergodome {

bool serves(const StarSettings& found, const StarSettings& asked) {
  return (asked.about || !found.about) && serves_pixel(found.pixel, asked.pixel, asked.about) &&
         found.grid_px == asked.grid_px && found.least_cell_px == asked.least_cell_px &&
         found.faintest == asked.faintest && found.redshift == asked.redshift &&
         found.magnification == asked.magnification;
}

}  // namespace ergodome
