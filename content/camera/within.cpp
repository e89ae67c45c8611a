#include "content/camera/within.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "content/show/animated_show.h"
#include "content/show/stereo_eyes.h"
#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

bool has_polygon_objects(const Show& show) {
  return std::ranges::any_of(show.objects, [](const auto& object) { return object.method == ObjectMethod::polygon; });
}

}  // namespace

double deepest_rest(Spacetime spacetime) { return std::ceil(1e5 * min_interior_radius(spacetime)) * 1e-5; }

bool has_inside(Spacetime spacetime) { return deepest_rest(spacetime) < horizon_radius(spacetime) / nearest_rest; }

std::optional<LocalText> hidden_within(const Show& show) {
  if (has_polygon_objects(show)) {
    return LocalText{{"en", "objects with method = \"polygon\""}, {"de", "Objekte mit method = \"polygon\""}};
  }
  return model_for_fall(show.stereo.model) != show.stereo.model
             ? std::optional(LocalText{{"en", "stereo.model = \"flat\""}, {"de", "stereo.model = \"flat\""}})
             : std::nullopt;
}

std::optional<LocalText> kept_outside(const Show& show) {
  if (!has_inside(spacetime_of(show))) {
    return LocalText{{"en", "at this spin the inside of the hole cannot be shown"},
                     {"de", "bei diesem Spin lässt sich das Innere des Lochs nicht zeigen"}};
  }
  if (find_animation(show, "hole.spin") != nullptr) {
    return LocalText{{"en", "falling in is not possible while the spin is animated"},
                     {"de", "bei animiertem Spin ist kein Fall ins Loch möglich"}};
  }
  if (!has_polygon_objects(show)) {
    return std::nullopt;
  }
  return LocalText{{"en", "the objects of this show cannot be shown inside the horizon"},
                   {"de", "die Objekte dieser Show lassen sich innerhalb des Horizonts nicht darstellen"}};
}

}  // namespace ergodome
