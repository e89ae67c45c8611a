#pragma once

#include <array>
#include <string>
#include <vector>

#include "kernels/core/vector3.h"

// What a diagram is made of, before it is drawn: in flat space, lengths in M.
namespace ergodome {

//! A colour in linear light.
using Ink = std::array<float, 3>;

//! Ink of three bytes as a display shows them, 0xRRGGBB.
Ink display_ink(unsigned rgb);

//! A corner of a triangle; three after one another are one.
struct DiagramCorner {
  Vector3<double> place;
  Vector3<float> normal;
  std::array<float, 4> color;  //!< linear light, and how much it covers
  //! Place on a checkerboard of fields of size 1, and the factor on every other field's light.
  std::array<float, 3> checker = {0.0F, 0.0F, 1.0F};
};

//! Straight lines from place to place.
struct DiagramLine {
  std::vector<Vector3<double>> places;
  Ink ink;
  double width_px = 1.0;  //!< in a picture 720 pixels high
};

//! Words beside a place.
struct DiagramLabel {
  Vector3<double> place;
  std::string text;
};

//! A line of the legend.
struct LegendLine {
  enum class Sign { none, line, field };
  Sign sign = Sign::none;
  Ink ink{};
  std::string text;
};

//! Everything at one instant.
struct DiagramScene {
  std::vector<DiagramCorner> solids;  //!< nothing is seen through them
  std::vector<DiagramCorner> veils;   //!< apparent meshes: what is behind them shows through
  std::vector<DiagramLine> lines;
  std::vector<DiagramLabel> labels;
  std::vector<LegendLine> legend;
  std::vector<Vector3<double>> framed;  //!< places that a picture should have in it
  double photon_sphere = 0.0;           //!< radius of a sphere whose outline is drawn; 0: none
  int ray_count = 0;
};

//! Adds a sphere about a place.
void add_ball(std::vector<DiagramCorner>& corners, const Vector3<double>& middle, double radius, const Ink& ink);

//! Circle in a plane z = height about the z axis.
std::vector<Vector3<double>> level_circle(double radius, double height);

namespace diagram_inks {
//! Colours of the images, in their order: told apart by most people with colour-blind eyes, too (Okabe & Ito 2008).
Ink of_image(int order);
//! A colour half way to paper.
Ink pale(const Ink& ink);
Ink paper();
Ink hole();
Ink grid();
Ink axis();
Ink words();
Ink observer();
Ink photon_sphere();
Ink other_rays();
}  // namespace diagram_inks

}  // namespace ergodome
