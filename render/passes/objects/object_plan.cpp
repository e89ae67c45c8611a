#include <algorithm>

#include "content/show/stereo_eyes.h"
#include "render/passes/objects/object_kind.h"

namespace ergodome {

void plan_mesh_loading(PlanWriter& plan, const std::string& reason) {
  plan.pass("load_meshes", WorkMoment::start, 1, static_cast<long>(plan.maximum().objects.size()), reason);
}

void plan_polygons(PlanWriter& plan) {
  const Show& show = plan.maximum();
  if (!has_objects(show, ObjectMethod::polygon)) {
    return;
  }
  const std::string objects = plan.why("objects");
  plan_mesh_loading(plan, objects);
  plan.pass("open_gl", WorkMoment::start, 1, 1, objects);
  plan.buffer("meshes", WorkMoment::start, plan.request().mesh_bytes, objects);
  if (!needs_polygons(show, plan.request().mode)) {
    return;
  }
  const bool lit = std::ranges::any_of(show.objects, &ObjectSettings::lit);
  const std::string tables = lit ? objects + ", " + plan.why("light") : objects;
  plan.pass("make_connection_table", WorkMoment::position, 0, 0, tables);
  plan.buffer("connecting rays", WorkMoment::position, 0, tables);
  // Eyes that share the head's lens have one picture of the sky, but each sees objects from its own
  // position.
  const bool shared = share_camera(plan.maximum().stereo);
  const long eyes = shared ? plan.shown() : plan.eyes();
  const bool known = !shared || !plan.eyes_are_together_at_times();
  plan.pass("draw_objects", WorkMoment::picture, known ? eyes : 0, known ? eyes * plan.pixels() : 0, objects);
  plan.buffer("objects' picture", WorkMoment::start, 0, objects);
}

}  // namespace ergodome
