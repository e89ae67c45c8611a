#include "render/diagram/diagram_surroundings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/spacetime/kerr/kerr.h"
#include "render/diagram/view_outline.h"

namespace ergodome {

namespace {

constexpr double grid_width_px = 1.0;
constexpr double axis_width_px = 1.3;
constexpr double outline_width_px = 1.3;
//! Minimum length of the drawn spin axis on each side of the hole's center [M].
constexpr double min_axis = 4.5;

}  // namespace

double round_step(double about) {
  const double power = std::pow(10.0, std::floor(std::log10(about)));
  const double rest = about / power;
  return power * (rest < 1.5 ? 1.0 : rest < 3.5 ? 2.0 : rest < 7.5 ? 5.0 : 10.0);
}

void add_hole(Spacetime spacetime, DiagramScene& scene) {
  const double horizon = horizon_radius(spacetime);
  add_ball(scene.solids, {0.0, 0.0, 0.0}, horizon, diagram_inks::hole());
  for (const double side : {-1.5, 1.5}) {
    scene.framed.insert(scene.framed.end(),
                        {{side * horizon, 0.0, 0.0}, {0.0, side * horizon, 0.0}, {0.0, 0.0, side * horizon}});
  }
  if (spacetime.spin == 0.0) {
    scene.photon_sphere = photon_orbit_radius(Spacetime{}, 1.0);
    scene.legend.push_back({LegendLine::Sign::field, diagram_inks::hole(),
                            fmt::format("non-spinning hole: horizon r = {:.6g} M; circle: photon sphere, r = {:.6g} M",
                                        horizon, scene.photon_sphere)});
    return;
  }
  const double static_limit = static_limit_radius(spacetime, 0.5 * pi);
  scene.lines.push_back({level_circle(static_limit, 0.0), diagram_inks::photon_sphere(), outline_width_px});
  scene.legend.push_back(
      {LegendLine::Sign::field, diagram_inks::hole(),
       fmt::format("hole with spin {:.4g}: horizon r = {:.4g} M; circle: equator of the ergosphere, r = {:.6g} M",
                   spacetime.spin, horizon, static_limit)});
}

void add_grid(double extent, double label_azimuth, DiagramScene& scene) {
  const double step = round_step(extent / 4.0);
  const int circles = static_cast<int>(std::floor(1.02 * extent / step));
  const double end = (circles + 0.5) * step;
  for (int i = 1; i <= circles; ++i) {
    const double r = i * step;
    scene.lines.push_back({level_circle(r, 0.0), diagram_inks::grid(), grid_width_px});
    scene.labels.push_back(
        {{r * std::cos(label_azimuth), r * std::sin(label_azimuth), 0.0}, fmt::format("{:.6g} M", r)});
  }
  const Vector3<double> ends[3] = {{end, 0.0, 0.0}, {0.0, end, 0.0}, {0.0, 0.0, std::max(0.5 * step, min_axis)}};
  constexpr const char* names[3] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    scene.lines.push_back({{-ends[i], ends[i]}, diagram_inks::axis(), axis_width_px});
    scene.labels.push_back({1.03 * ends[i], names[i]});
  }
}

void add_observer(const ViewSettings& view, const EyeCamera& eye, double length, DiagramScene& scene) {
  const Vector3<double> position = position_of(eye);
  const Ink ink = diagram_inks::observer();
  add_ball(scene.solids, position, 0.06 * length, ink);
  const ViewOutline outline = view_outline(view, eye);
  std::vector<Vector3<double>> border;
  border.reserve(outline.border.size());
  for (const Vector3<double>& direction : outline.border) {
    border.push_back(position + length * direction);
  }
  for (const Vector3<double>& direction : outline.corners) {
    scene.lines.push_back({{position, position + length * direction}, ink, outline_width_px});
  }
  if (border.empty()) {
    scene.lines.push_back({{position, position + length * forward_of(eye)}, ink, outline_width_px});
  }
  scene.framed.push_back(position);
  scene.framed.insert(scene.framed.end(), border.begin(), border.end());
  scene.lines.push_back({std::move(border), ink, outline_width_px});
  scene.legend.push_back({LegendLine::Sign::line, ink,
                          fmt::format("observer at r = {:.4g} M, and {}", eye.r,
                                      outline.border.empty() ? "the direction it faces" : "the edge of its view")});
}

}  // namespace ergodome
