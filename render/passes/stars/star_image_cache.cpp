#include "render/passes/stars/star_image_cache.h"

namespace ergodome {

bool serves(const StarSettings& found, const StarSettings& asked) {
  return (asked.about || !found.about) && serves_pixel(found.pixel, asked.pixel, asked.about) &&
         found.grid_px == asked.grid_px && found.min_cell_px == asked.min_cell_px && found.faintest == asked.faintest &&
         found.course.slow == asked.course.slow && found.redshift == asked.redshift &&
         found.magnification == asked.magnification;
}

}  // namespace ergodome
