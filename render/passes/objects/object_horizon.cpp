#include "render/passes/objects/object_horizon.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "content/objects/object_motion.h"
#include "content/show/animated_show.h"
#include "content/show/show_errors.h"
#include "kernels/core/error.h"
#include "kernels/spacetime/kerr/kerr.h"
#include "render/passes/objects/object_reach.h"

namespace ergodome {

namespace {

//! Returns the show times to check [s]: 0, those of the keys of an object's position and of the
//! spin, and up to 15 between two of them, but fewer if there are many keys.
std::vector<double> sampled_times(const Show& show, const ObjectSettings& object) {
  constexpr std::size_t max_samples = 1024;
  std::vector<double> keys_s = {0.0};
  for (const ObjectKey& key : object.keys) {
    keys_s.push_back(key.time_s);
  }
  if (const Animation* const spin = find_animation(show, "hole.spin")) {
    for (const auto& key : spin->keys) {
      keys_s.push_back(key.time_s);
    }
  }
  std::ranges::sort(keys_s);
  const int between_keys = static_cast<int>(std::clamp<std::size_t>(max_samples / keys_s.size(), 1, 16));
  std::vector<double> times_s;
  for (std::size_t i = 0; i + 1 < keys_s.size(); ++i) {
    for (int k = 0; keys_s[i + 1] > keys_s[i] && k < between_keys; ++k) {
      times_s.push_back(std::lerp(keys_s[i], keys_s[i + 1], static_cast<double>(k) / between_keys));
    }
  }
  times_s.push_back(keys_s.back());
  return times_s;
}

}  // namespace

std::vector<ObjectInHorizon> objects_in_horizon(const Show& show, const ObjectMeshes& meshes) {
  std::vector<ObjectInHorizon> all;
  for (std::size_t i = 0; i < show.objects.size(); ++i) {
    const ObjectSettings& object = show.objects[i];
    // Skips polygon objects, and objects on orbits, which are always outside the horizon.
    if (object.method != ObjectMethod::trace || object.orbit) {
      continue;
    }
    const TriangleMesh& mesh = meshes.meshes[meshes.mesh_of[i]];
    const double radius = object.size * radius_of(mesh);
    std::optional<ObjectInHorizon> inside;
    bool always_whole = true;
    std::optional<RadialRange> at_rest;
    for (const double time_s : sampled_times(show, object)) {
      const RadialRange range = object.keys.empty() && at_rest
                                    ? *at_rest
                                    : radial_range(mesh, placement_at(object, time_s), object.size, radius);
      at_rest = range;
      const double horizon_r = horizon_radius(spacetime_at(show, time_s));
      always_whole = always_whole && range.farthest <= horizon_r;
      if (!inside && range.nearest < horizon_r) {
        inside = {i, false, time_s, horizon_r};
      }
    }
    if (inside) {
      inside->always_whole = always_whole;
      all.push_back(*inside);
    }
  }
  return all;
}

std::string note_of(const Show& show, const ObjectInHorizon& inside) {
  const std::string own = fmt::format("objects[{}]", inside.object);
  std::string key = own;
  for (const char* const part : {".position", ".key", ".size"}) {
    if (key == own && show.lines.contains(own + part)) {
      key += part;
    }
  }
  const std::string where = fmt::format("inside the horizon, r = {:.3g} M", inside.horizon_r);
  const std::string problem =
      inside.always_whole
          ? fmt::format("is {}, and is never visible", where)
          : fmt::format("is partly {}, at {:.6g} s: the part inside is not visible", where, inside.first_s);
  return named_by(show, key, Error(own, problem, "move it farther out, or make it smaller")).what();
}

}  // namespace ergodome
