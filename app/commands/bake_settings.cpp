#include "app/commands/bake_settings.h"

#include "content/show/animated_show.h"
#include "kernels/projection/pixel_measure.h"
#include "render/frame/show_renderer.h"

namespace ergodome {

BakeSettings bake_settings(const Show& show, int size_px, double budget_px) {
  BakeSettings settings;
  // An animated field of view is baked at its minimum, where pixels are finest.
  const ViewSettings view = show_at_least(show).view;
  const Projection projection = make_projection(view, size_px > 0 ? size_px : view.size_px, 0.0);
  settings.pixel = pixel_angle(projection);
  settings.share = sky_share(projection);
  settings.budget_px = budget_px > 0.0 ? budget_px : show.quality.budget_px;
  return settings;
}

}  // namespace ergodome
