#include "render/passes/objects/lamp_guesses.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "kernels/objects/light_ray.h"

namespace ergodome {

namespace {

double square_of(const Vector3<double>& v) { return dot(v, v); }

//! Returns the center of an object that appears small from the hole. Returns nothing for larger
//! objects, because light past the hole may reach parts of such an object along different rays.
std::optional<Vector3<double>> middle_of(const std::vector<Vector3<double>>& corners) {
  constexpr double small = 0.25;
  if (corners.empty()) {
    return std::nullopt;
  }
  Vector3<double> middle = {0.0, 0.0, 0.0};
  for (const Vector3<double>& corner : corners) {
    middle = middle + (1.0 / static_cast<double>(corners.size())) * corner;
  }
  const bool is_small = std::ranges::all_of(corners, [&](const Vector3<double>& corner) {
    return square_of(corner - middle) < small * small * square_of(middle);
  });
  return is_small ? std::optional(middle) : std::nullopt;
}

LampCorrections corrections_at(Spacetime spacetime, const LampSource& lamp, const Vector3<double>& position) {
  LampCorrections corrections = {};
  constexpr double beside_horizon = 1.01;
  if (square_of(position) > std::pow(beside_horizon * horizon_radius(spacetime), 2)) {
    const LocalFrame frame = local_frame(spacetime, position);
    for (int way = 0; way < 2; ++way) {
      LightRay ray{};
      light_ray(spacetime, frame, position, lamp.position, way + 1, LightRayParts::way, corrections.by_way[way], ray);
    }
  }
  return corrections;
}

}  // namespace

std::vector<LampCorrections> lamp_guesses(Spacetime spacetime, const LampSource& lamp,
                                          const std::vector<ObjectSettings>& objects,
                                          const std::vector<PlacedOutline>& outlines) {
  std::vector<LampCorrections> guesses(objects.size());
  for (std::size_t i = 0; i < objects.size() && spacetime.spin != 0.0; ++i) {
    const auto middle = objects[i].lit ? middle_of(outlines[i].corners) : std::nullopt;
    guesses[i] = middle ? corrections_at(spacetime, lamp, *middle) : LampCorrections{};
  }
  return guesses;
}

}  // namespace ergodome
