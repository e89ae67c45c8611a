#include "render/passes/objects/traced_objects.h"

#include <algorithm>

#include "kernels/projection/pixel_measure.h"
#include "render/lens/direct_lens.h"
#include "render/passes/objects/object_pixels.h"

namespace ergodome {

namespace {

constexpr int picture_step_limit = 4000;
//! Local error of an object ray's path, as a fraction of the tolerance of a pixel.
constexpr double part_of_tolerance = 0.01;

SurfaceAppearance appearance_of(const ObjectSettings& object, const Surface& surface) {
  const auto factor = [&](double part) { return static_cast<float>(object.exposure * part); };
  SurfaceAppearance appearance{
      surface, {factor(object.color.x), factor(object.color.y), factor(object.color.z)}, 0.0F, 0.0F, 1.0F, object.lit};
  if (object.checker) {
    appearance.columns = static_cast<float>(object.checker->columns);
    appearance.rows = static_cast<float>(object.checker->rows);
    appearance.dark = static_cast<float>(object.checker->dark);
  }
  return appearance;
}

std::vector<SurfaceAppearance> appearances_of(const Show& show, const std::vector<Surface>& surfaces) {
  std::vector<SurfaceAppearance> appearances;
  appearances.reserve(surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    appearances.push_back(appearance_of(show.objects[i], surfaces[i]));
  }
  return appearances;
}

LampSource lamp_of(const Show& show) {
  return show.light ? LampSource{show.light->position, show.light->strength, show.light->falloff, show.effects.redshift}
                    : LampSource{};
}

}  // namespace

TracedObjects::TracedObjects(const Show& show, Backend backend)
    : backend_(backend),
      objects_(show.objects),
      lamp_(lamp_of(show)),
      shifted_(show.effects.redshift),
      surfaces_(show, backend),
      appearances_(backend, appearances_of(show, surfaces_.surfaces()), "meshes"),
      placed_(backend, show.objects.size(), "meshes"),
      guesses_(backend, show.objects.size(), "meshes") {}

std::unique_ptr<TracedObjects> traced_objects_of(const Show& show, Backend backend) {
  return has_objects(show, ObjectMethod::trace) ? std::make_unique<TracedObjects>(show, backend) : nullptr;
}

double TracedObjects::farthest_r(double time_s) const {
  return place_meshes(objects_, surfaces_.trees(), time_s).max_r;
}

PlacedMeshes TracedObjects::hiding(double time_s) const {
  std::vector<ObjectSettings> objects;
  std::vector<TriangleTree> trees;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const TriangleTree& tree = surfaces_.host_trees()[i];
    if (tree.nodes != nullptr) {
      objects.push_back(objects_[i]);
      trees.push_back(tree);
    }
  }
  return objects.empty() ? PlacedMeshes{} : place_meshes(objects, trees, time_s);
}

long TracedObjects::triangle_count() const { return surfaces_.triangle_count(); }

ObjectScene TracedObjects::scene_for(const PictureView& view) {
  const EyeCamera& eye = view.camera();
  const PlacedMeshes placed = place_meshes(objects_, surfaces_.trees(), view.time_s);
  placed_.write(placed.meshes.data(), placed.meshes.size());
  guess_lamp_rays(eye.spacetime, view.time_s);
  const double tolerance =
      std::clamp(part_of_tolerance * view.tolerance_px * pixel_angle(view.projection), 1e-10, 1e-6);
  ObjectScene scene{station_of(eye),
                    view.projection,
                    {},
                    placed.around(eye.spacetime, placed_.data()),
                    appearances_.data(),
                    lamp_,
                    guesses_.data(),
                    {tolerance, picture_step_limit, -eye.clock_lead},
                    shifted_,
                    std::ranges::any_of(placed.meshes, &PlacedMesh::retarded),
                    {}};
  if (view.omni != nullptr) {
    scene.omni = view.omni->cameras->exact(view.omni->side);
    const std::vector<double>& coefficients = view.omni->cameras->coefficients();
    if (cameras_.size() < coefficients.size()) {
      cameras_ = Buffer<double>(backend_, coefficients.size(), "objects' cameras");
    }
    cameras_.write(coefficients.data(), coefficients.size());
    scene.omni.coefficients = cameras_.data();
  }
  std::copy(&eye.frame_from_view[0][0], &eye.frame_from_view[0][0] + 9, &scene.frame_from_view[0][0]);
  return scene;
}

void TracedObjects::guess_lamp_rays(Spacetime spacetime, double time_s) {
  // All blocks of rows and all eyes of a picture share the starting values for lamp rays. Without
  // spin, these are always zero.
  const std::pair now(spacetime, spacetime.spin != 0.0 ? time_s : 0.0);
  if (!(lamp_.strength > 0.0) || guessed_for_ == now) {
    return;
  }
  guessed_for_ = now;
  guesses_.write(lamp_guesses(spacetime, lamp_, objects_, outlines(time_s)).data(), objects_.size());
}

ObjectLayer TracedObjects::draw_rows(const PictureView& view, const RowBlock& rows,
                                     const std::optional<FlatEyeSight>& sight) {
  ObjectPixels pixels(backend_, scene_for(view), rows.first, rows.count, sight);
  pixels.draw();
  const std::size_t count = pixels.time().size();
  if (time_.size() < count) {
    rgba_ = Buffer<float>(backend_, 4 * count, "objects' picture");
    time_ = Buffer<float>(backend_, count, "objects' picture");
  }
  rgba_.write(pixels.rgba().data(), 4 * count);
  time_.write(pixels.time().data(), count);
  return {rgba_.data(), time_.data()};
}

}  // namespace ergodome
