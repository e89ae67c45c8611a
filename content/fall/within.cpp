#include "content/fall/within.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "content/show/animated_show.h"
#include "kernels/spacetime/kerr/kerr.h"

namespace ergodome {

namespace {

bool has_polygon_objects(const Show& show) {
  return std::ranges::any_of(show.objects, [](const auto& object) { return object.method == ObjectMethod::polygon; });
}

constexpr const char* polygon_objects = "objects of the method polygon";
constexpr const char* polygon_objects_german = "Objekte der Methode polygon";

}  // namespace

double deepest_rest(double spin) { return std::ceil(1e5 * least_interior_radius(spin)) * 1e-5; }

bool has_inside(double spin) { return deepest_rest(spin) < horizon_radius(spin) / nearest_rest; }

std::optional<LocalText> hidden_within(const Show& show) {
  if (has_polygon_objects(show)) {
    return LocalText{{"en", polygon_objects}, {"de", polygon_objects_german}};
  }
  return show.stereo.model == StereoModel::flat
             ? std::optional(LocalText{{"en", "eyes of the model flat"}, {"de", "Augen des Modells flat"}})
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
  if (!has_polygon_objects(show)) {
    return std::nullopt;
  }
  return LocalText{{"en", std::string(polygon_objects) + " cannot be shown within the horizon"},
                   {"de", std::string("innerhalb des Horizonts nicht zu zeigen: ") + polygon_objects_german}};
}

}  // namespace ergodome
