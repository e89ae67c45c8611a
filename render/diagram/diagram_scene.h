#pragma once

#include <array>
#include <string>
#include <vector>

#include "content/show/object_settings.h"
#include "kernels/core/vector3.h"
#include "render/diagram/apparent_mesh.h"

// Contents of a diagram before drawing: in flat space, lengths in M.
namespace ergodome {

//! A color in linear light.
using Ink = std::array<float, 3>;

//! Converts an sRGB color 0xRRGGBB to linear light.
Ink display_ink(unsigned rgb);

//! A corner of a triangle; each three successive corners form a triangle.
struct DiagramCorner {
  Vector3<double> position;
  Vector3<float> normal;
  std::array<float, 4> color;  //!< linear light and opacity
  //! Checkerboard coordinates (two numbers; fields have size 1), and the factor on the light of
  //! every second field.
  std::array<float, 3> checker = {0.0F, 0.0F, 1.0F};
};

//! A polyline.
struct DiagramLine {
  std::vector<Vector3<double>> positions;
  Ink ink;
  double width_px = 1.0;  //!< width of the line in a picture 720 pixels high
};

//! A text beside a position.
struct DiagramLabel {
  Vector3<double> position;
  std::string text;
};

//! A line of the legend.
struct LegendLine {
  enum class Sign { none, line, field };
  Sign sign = Sign::none;
  Ink ink{};
  std::string text;
};

//! Everything to draw at one instant.
struct DiagramScene {
  std::vector<DiagramCorner> solids;  //!< opaque triangles
  //! translucent triangles: apparent meshes and former positions
  std::vector<DiagramCorner> veils;
  std::vector<DiagramLine> lines;
  std::vector<DiagramLabel> labels;
  std::vector<LegendLine> legend;
  //! Positions that the automatic camera keeps inside the picture.
  std::vector<Vector3<double>> framed;
  double photon_sphere = 0.0;  //!< radius of a sphere whose outline is drawn; 0: none
  int ray_count = 0;
};

//! Adds a sphere centered at `middle`.
void add_ball(std::vector<DiagramCorner>& corners, const Vector3<double>& middle, double radius, const Ink& ink);

//! Returns a circle around the z axis in the plane z = height.
std::vector<Vector3<double>> level_circle(double radius, double height);

namespace diagram_inks {
//! Returns the color for rays of an image order; all orders from 5 on have the same. The colors are
//! distinguishable for most people with color vision deficiency, too (Okabe & Ito 2008).
Ink of_image(int order);
//! Returns a mixture of 45 % of a color and 55 % of the paper's color.
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

//! Adds an object at its position, with its own color and checkerboard; textures are omitted.
void add_solid(const ObjectSettings& object, const TriangleMesh& mesh, const ObjectPlacement& placement,
               std::vector<DiagramCorner>& corners);

//! Adds a translucent image of an object at its apparent position, in one color with the object's
//! checkerboard.
void add_veil(const ObjectSettings& object, const ApparentMesh& mesh, const Ink& ink,
              std::vector<DiagramCorner>& corners);

//! Adds a translucent object at a former position.
void add_veil(const ObjectSettings& object, const TriangleMesh& mesh, const ObjectPlacement& placement, const Ink& ink,
              std::vector<DiagramCorner>& corners);

}  // namespace ergodome
