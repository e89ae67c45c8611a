#include "content/objects/object_checks.h"

#include <fmt/format.h>

#include <algorithm>

#include "content/camera/free_fall.h"
#include "content/show/animated_show.h"

namespace ergodome {

std::optional<PolygonLimit> polygon_limit(const Show& show) {
  if (show.spin != 0.0 || find_animation(show, "hole.spin") != nullptr) {
    return PolygonLimit{"are drawn with method = \"polygon\", which supports only a hole without spin (Schwarzschild)",
                        "write method = \"trace\", or set spin = 0 in [hole] and do not animate it"};
  }
  for (const CameraKey& key : show.camera.keys) {
    if (!(key.r > nearest_of_observers)) {
      return PolygonLimit{fmt::format("are drawn with method = \"polygon\", which needs a camera outside the photon "
                                      "sphere (camera at r = {} M)",
                                      key.r),
                          "keep the camera farther out than 3 M, or write method = \"trace\""};
    }
  }
  if (show.camera.orbit && !(show.camera.orbit->least_r() > nearest_of_observers)) {
    return PolygonLimit{fmt::format("are drawn with method = \"polygon\", which needs a camera outside the photon "
                                    "sphere (it falls to r = {:.6g} M)",
                                    show.camera.orbit->least_r()),
                        "keep the camera farther out than 3 M, or write method = \"trace\""};
  }
  return std::nullopt;
}

void check_objects(const TomlTable& root, const Show& show) {
  if (show.objects.empty()) {
    return;
  }
  if (!show.light && std::ranges::any_of(show.objects, &ObjectSettings::lit)) {
    throw root.error_at("objects", "have light = \"lambert\", but the show has no [light]",
                        "add [light] with position = [x, y, z] and strength");
  }
  const ObjectMethod method = show.objects.front().method;
  if (!std::ranges::all_of(show.objects, [&](const ObjectSettings& each) { return each.method == method; })) {
    throw root.error_at("objects", "use two different methods", "write the same method for all of them");
  }
  if (method == ObjectMethod::trace) {
    return;
  }
  if (const std::optional<PolygonLimit> limit = polygon_limit(show)) {
    throw root.error_at("objects", limit->problem, limit->remedy);
  }
}

}  // namespace ergodome
