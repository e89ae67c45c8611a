#include "render/diagram/diagram_scene.h"

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"

namespace ergodome {

Ink display_ink(unsigned rgb) {
  const auto linear = [](unsigned byte) {
    const double v = (byte & 0xFFU) / 255.0;
    return static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
  };
  return {linear(rgb >> 16U), linear(rgb >> 8U), linear(rgb)};
}

namespace diagram_inks {
Ink of_image(int order) {
  constexpr unsigned inks[] = {0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0x8C6D1F};
  return display_ink(inks[std::clamp(order, 1, 5) - 1]);
}
Ink pale(const Ink& ink) {
  const Ink on = paper();
  return {0.45F * ink[0] + 0.55F * on[0], 0.45F * ink[1] + 0.55F * on[1], 0.45F * ink[2] + 0.55F * on[2]};
}
Ink paper() { return display_ink(0xF7F6F3); }
Ink hole() { return display_ink(0x000000); }
Ink grid() { return display_ink(0xDDDCD8); }
Ink axis() { return display_ink(0xA9A8A4); }
Ink words() { return display_ink(0x2B2B2B); }
Ink observer() { return display_ink(0x3D3D3D); }
Ink photon_sphere() { return display_ink(0x6E6E6E); }
Ink other_rays() { return display_ink(0x9A9EA8); }
}  // namespace diagram_inks

void add_ball(std::vector<DiagramCorner>& corners, const Vector3<double>& middle, double radius, const Ink& ink) {
  constexpr int segments = 64;
  constexpr int rings = 32;
  const auto corner = [&](int ring, int segment) {
    const double theta = pi * ring / rings;
    const double phi = full_turn * segment / segments;
    const Vector3<double> n = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    return DiagramCorner{middle + radius * n,
                         {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)},
                         {ink[0], ink[1], ink[2], 1.0F}};
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int segment = 0; segment < segments; ++segment) {
      corners.insert(corners.end(), {corner(ring, segment), corner(ring + 1, segment), corner(ring + 1, segment + 1)});
      corners.insert(corners.end(), {corner(ring, segment), corner(ring + 1, segment + 1), corner(ring, segment + 1)});
    }
  }
}

std::vector<Vector3<double>> level_circle(double radius, double height) {
  constexpr int sides = 180;
  std::vector<Vector3<double>> circle;
  circle.reserve(sides + 1);
  for (int i = 0; i <= sides; ++i) {
    const double angle = full_turn * i / sides;
    circle.push_back({radius * std::cos(angle), radius * std::sin(angle), height});
  }
  return circle;
}

}  // namespace ergodome
