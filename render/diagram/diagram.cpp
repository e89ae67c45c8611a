#include "render/diagram/diagram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "content/show/animated_show.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/spacetime/schwarzschild/apparent_position.h"
#include "render/diagram/diagram_scene.h"
#include "render/diagram/diagram_surroundings.h"
#include "render/diagram/light_curve.h"
#include "render/diagram/spread_choice.h"
#include "render/diagram/traced_curves.h"
#include "render/diagram/view_outline.h"
#include "render/eyes/view_projection.h"

namespace ergodome {

namespace {

constexpr double ray_width_px = 1.6;
constexpr double other_ray_width_px = 1.0;
constexpr double sight_width_px = 1.0;
//! Maximum number of rays per object image for which a dashed line shows the apparent direction up
//! to the apparent position.
constexpr int max_sights = 6;
//! Length of a dash, as a fraction of the scene's extent.
constexpr double dash_share = 0.012;
//! Deviation from a straight line that is invisible, as a fraction of the scene's extent.
constexpr double finest_bend = 1.0 / 2000.0;
//! Drawn length of the borders of the observer's view, as a fraction of the scene's extent.
constexpr double view_share = 0.14;
//! Maximum number of mesh corners among which the starting points of rays are selected.
constexpr std::size_t max_candidates = 4096;
constexpr int coarse_width_px = 192;
//! Maximum number of triangles of all objects together. For each image order that is drawn, the
//! apparent mesh adds as many triangles again, or more if they are divided.
constexpr long max_diagram_triangles = 2'000'000;

double far_from_hole(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

std::string turns_of(int order) {
  return order == 1   ? "less than half a turn"
         : order == 2 ? "half a turn to one turn"
                      : fmt::format("{:.2g} to {:.2g} turns", 0.5 * (order - 1), 0.5 * order);
}

//! Color and width of a dashed line.
struct DashStyle {
  Ink ink;
  double width_px;
};
void add_dashes(const Vector3<double>& from, const Vector3<double>& to, double dash, const DashStyle& style,
                DiagramScene& scene) {
  const Vector3<double> way = to - from;
  const double length = far_from_hole(way);
  for (double at = 0.0; at < length; at += 2.0 * dash) {
    scene.lines.push_back(
        {{from + (at / length) * way, from + (std::min(at + dash, length) / length) * way}, style.ink, style.width_px});
  }
}

//! Returns an object's placement with the position on its orbit from which light reaches the camera
//! after `delay` [M]; the orientation is not changed.
ObjectPlacement placement_before(ObjectPlacement placement, double delay) {
  const double angle = placement.rate * delay;
  placement.position = std::cos(angle) * placement.position - std::sin(angle) * placement.ahead;
  return placement;
}

}  // namespace

//! A show at one instant.
struct Diagram::Moment {
  Show show;
  double time_s;
  EyeCamera eye;
  Vector3<double> observer;
  std::vector<ObjectPlacement> placements;
  //! distance from the hole to the observer or to the farthest point of an object, if larger [M]
  double extent;
};

Diagram::Diagram(const Show& show, const DiagramSettings& settings) : show_(show), settings_(settings) {
  if (show.objects.empty()) {
    throw Error("diagram", show.name + " has no objects", "name a show with [[objects]]");
  }
  const bool spins = show.spin != 0.0 || find_animation(show, "hole.spin") != nullptr;
  const bool retarded = std::ranges::any_of(show.objects, &ObjectSettings::retarded);
  connects_ = !spins && !retarded;
  if (!connects_ && !settings.images.empty()) {
    throw Error("diagram --images",
                fmt::format("{} has {}, so rays are traced from the view, and images cannot be selected", show.name,
                            spins ? "a spinning hole" : "retarded objects"),
                "omit --images");
  }
  meshes_ = load_meshes(show);
  long triangles = 0;
  for (const std::size_t mesh : meshes_.mesh_of) {
    triangles += meshes_.meshes[mesh].triangle_count();
  }
  if (triangles > max_diagram_triangles) {
    throw Error("diagram", fmt::format("{} has {} triangles", show.name, triangles),
                fmt::format("reduce its meshes to at most {} triangles", max_diagram_triangles));
  }
  if (settings_.images.empty()) {
    settings_.images = {1, 2};
  }
}

DiagramScene Diagram::at(double time_s) const {
  const Show now = show_at(show_, time_s);
  const EyeCamera eye = eye_camera(now, camera_pose(now, time_s), 0.0);
  Moment moment{now, time_s, eye, position_of(eye), {}, eye.r};
  for (std::size_t i = 0; i < now.objects.size(); ++i) {
    const ObjectSettings& object = now.objects[i];
    moment.placements.push_back(placement_at(object, time_s));
    moment.extent = std::max(moment.extent, far_from_hole(moment.placements.back().position) +
                                                object.size * radius_of(meshes_.meshes[meshes_.mesh_of[i]]));
  }
  DiagramScene scene;
  scene.legend.push_back({LegendLine::Sign::none, {}, fmt::format("{}, {:.6g} s", text_in(show_.title, ""), time_s)});
  // Later lines are drawn over earlier ones at the same position.
  add_grid(moment.extent, eye.phi - 0.3 * pi, scene);
  add_hole(spacetime_of(now), scene);
  add_observer(now.view, eye, view_share * moment.extent, scene);
  add_objects(moment, scene);
  if (connects_) {
    add_connections(moment, scene);
  } else {
    add_traced_rays(moment, scene);
  }
  for (const std::vector<DiagramCorner>* corners : {&scene.solids, &scene.veils}) {
    for (const DiagramCorner& corner : *corners) {
      scene.framed.push_back(corner.position);
    }
  }
  return scene;
}

void Diagram::add_objects(const Moment& moment, DiagramScene& scene) const {
  for (std::size_t i = 0; i < moment.placements.size(); ++i) {
    add_solid(moment.show.objects[i], meshes_.meshes[meshes_.mesh_of[i]], moment.placements[i], scene.solids);
  }
}

void Diagram::add_connections(const Moment& moment, DiagramScene& scene) const {
  const auto shares = static_cast<int>(settings_.images.size() * moment.placements.size());
  const int rays = (settings_.rays + shares - 1) / shares;
  for (const int order : settings_.images) {
    const Ink ink = diagram_inks::of_image(order);
    for (std::size_t i = 0; i < moment.placements.size(); ++i) {
      const ObjectSettings& object = moment.show.objects[i];
      ApparentSettings settings;
      settings.tolerance = finest_bend * moment.extent;
      settings.torn = object.torn;
      add_veil(object,
               apparent_mesh(moment.observer, meshes_.meshes[meshes_.mesh_of[i]], moment.placements[i], object.size,
                             order, settings),
               ink, scene.veils);
      add_connecting_rays(moment, i, order, rays, scene);
    }
    scene.legend.push_back({LegendLine::Sign::line, ink,
                            fmt::format("image {}: light that goes {} around the hole", order, turns_of(order))});
  }
  scene.legend.push_back(
      {LegendLine::Sign::none,
       {},
       "solid: objects; translucent: where they appear, toward the arriving light (dashed), at its travel time"});
}

std::vector<Vector3<double>> Diagram::ray_starts(const Moment& moment, std::size_t object, int order,
                                                 std::size_t count) const {
  const TriangleMesh& mesh = meshes_.meshes[meshes_.mesh_of[object]];
  const ObjectPlacement& placement = moment.placements[object];
  ObjectPlacement turn = placement;
  turn.position = {0.0, 0.0, 0.0};
  const double size = moment.show.objects[object].size;
  const std::size_t stride = 1 + mesh.vertices.size() / max_candidates;
  std::vector<Vector3<double>> facing;
  std::vector<Vector3<double>> averted;
  for (std::size_t i = 0; i < mesh.vertices.size(); i += stride) {
    const Vector3<double> point = placed_point(placement, size, mesh.vertices[i].position);
    if (!apparent_vertex(moment.observer, point, order).connected) {
      continue;
    }
    const Vector3<double> normal = placed_point(turn, 1.0, mesh.vertices[i].normal);
    const bool faces = illuminance(moment.observer, point, normal, order, 1.0) > 0.0;
    (faces ? facing : averted).push_back(point);
  }
  std::vector<Vector3<double>> starts;
  for (const std::vector<Vector3<double>>* from : {&facing, &averted}) {
    for (const std::size_t i : spread_choice(*from, count - starts.size())) {
      starts.push_back((*from)[i]);
    }
  }
  return starts;
}

void Diagram::add_connecting_rays(const Moment& moment, std::size_t object, int order, int count,
                                  DiagramScene& scene) const {
  const Ink ink = diagram_inks::of_image(order);
  int sights = max_sights;
  for (const Vector3<double>& start : ray_starts(moment, object, order, static_cast<std::size_t>(count))) {
    std::vector<Vector3<double>> curve = light_curve(moment.observer, start, order);
    scene.framed.insert(scene.framed.end(), curve.begin(), curve.end());
    scene.lines.push_back({std::move(curve), ink, ray_width_px});
    ++scene.ray_count;
    if (sights-- > 0) {
      // The dashes start at 0.4 of the observer's radius from the observer; closer, they would
      // coincide with the ray.
      const Vector3<double> seen = apparent_vertex(moment.observer, start, order).seen;
      const Vector3<double> way = seen - moment.observer;
      const double apart = std::min(0.4 * moment.eye.r / far_from_hole(way), 1.0);
      add_dashes(moment.observer + apart * way, seen, dash_share * moment.extent,
                 {diagram_inks::pale(ink), sight_width_px}, scene);
    }
  }
}

void Diagram::add_traced_rays(const Moment& moment, DiagramScene& scene) const {
  const ObjectRays objects(moment.show, moment.time_s);
  const Projection coarse = make_projection(moment.show.view, coarse_width_px, 0.0);
  DelaysByOrder delays;
  const std::vector<TracedCurve> curves =
      traced_curves(moment.eye, coarse, objects, {settings_.rays, max_polygon_images, 1.15 * moment.extent});
  bool others = false;
  for (const TracedCurve& curve : curves) {
    const bool meets = curve.end == CurveEnd::object;
    others = others || !meets;
    scene.lines.push_back({curve.positions, meets ? diagram_inks::of_image(curve.order) : diagram_inks::other_rays(),
                           meets ? ray_width_px : other_ray_width_px});
    ++scene.ray_count;
    if (meets) {
      // Paths to objects must be inside the picture. Paths that continue to the sky may leave it.
      scene.framed.insert(scene.framed.end(), curve.positions.begin(), curve.positions.end());
      delays[curve.order][curve.object].push_back(curve.delay);
    }
  }
  const bool retarded = add_traced_images(moment, delays, scene);
  if (others) {
    scene.legend.push_back({LegendLine::Sign::line, diagram_inks::other_rays(),
                            "other rays of the view, traced back to the sky or into the hole"});
  }
  scene.legend.push_back(
      {LegendLine::Sign::none,
       {},
       retarded ? "solid: objects; translucent: where they were when the light left them" : "solid: objects"});
}

bool Diagram::add_traced_images(const Moment& moment, DelaysByOrder& delays, DiagramScene& scene) const {
  bool retarded = false;
  for (auto& [order, of_order] : delays) {
    for (auto& [object, values] : of_order) {
      const auto i = static_cast<std::size_t>(object);
      if (moment.show.objects[i].retarded && moment.placements[i].rate != 0.0) {
        std::ranges::nth_element(values, values.begin() + static_cast<long>(values.size() / 2));
        add_veil(moment.show.objects[i], meshes_.meshes[meshes_.mesh_of[i]],
                 placement_before(moment.placements[i], values[values.size() / 2]), diagram_inks::of_image(order),
                 scene.veils);
        retarded = true;
      }
    }
    scene.legend.push_back({LegendLine::Sign::line, diagram_inks::of_image(order),
                            fmt::format("image {}: light that goes {} around the hole", order, turns_of(order))});
  }
  return retarded;
}

}  // namespace ergodome
