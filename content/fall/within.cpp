#include "content/fall/within.h"

#include <algorithm>
#include <cmath>

#include "content/animated_show.h"
#include "kernels/metric/kerr.h"

namespace ergodome {

double deepest_rest(double spin) { return std::ceil(1e5 * least_interior_radius(spin)) * 1e-5; }

bool has_inside(double spin) { return deepest_rest(spin) < horizon_radius(spin) / nearest_rest; }

std::optional<LocalText> hidden_within(const Show& show) {
  struct Sight {
    bool is_there;
    const char* english;
    const char* german;
  };
  const Sight sights[] = {
      {std::ranges::any_of(show.objects, [](const auto& object) { return object.method == ObjectMethod::polygon; }),
       "objects of the method polygon", "Objekte der Methode polygon"},
      {show.stereo.model == StereoModel::flat, "eyes of the model flat", "Augen des Modells flat"},
  };
  const Sight* const hidden = std::ranges::find(sights, true, &Sight::is_there);
  return hidden != std::end(sights) ? std::optional(LocalText{{"en", hidden->english}, {"de", hidden->german}})
                                    : std::nullopt;
}

std::optional<LocalText> kept_outside(const Show& show) {
  if (!has_inside(show.spin)) {
    return LocalText{{"en", "a hole of this spin has no inside"}, {"de", "ein Loch mit diesem Spin hat kein Inneres"}};
  }
  if (find_animation(show, "hole.spin") != nullptr) {
    return LocalText{{"en", "nobody falls into a hole whose spin changes"},
                     {"de", "in ein Loch, dessen Spin sich ändert, fällt niemand"}};
  }
  const std::optional<LocalText> hidden = hidden_within(show);
  if (!hidden) {
    return std::nullopt;
  }
  return LocalText{{"en", hidden->at("en") + " cannot be shown within the horizon"},
                   {"de", "innerhalb des Horizonts nicht zu zeigen: " + hidden->at("de")}};
}

}  // namespace ergodome
