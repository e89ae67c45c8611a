#pragma once

#include <cstdint>

#include "kernels/core/vector3.h"
#include "kernels/mesh/placed_mesh.h"
#include "kernels/overlay/overlay_texture.h"

namespace ergodome {

//! A corner of triangles.
struct SurfaceVertex {
  float position[3];
  float normal[3];   //!< of unit length, outwards
  float texture[2];  //!< u to the right, v upwards; the image, or one checkerboard, is 0 to 1
};

//! What of a surface has one look.
struct SurfacePart {
  Vector3<float> color;  //!< linear light; multiplies the image
  bool textured;
  OverlayTexture image;
};

//! A mesh's triangles as they are looked at.
struct Surface {
  const SurfaceVertex* vertices;
  const std::uint32_t* indices;  //!< three a triangle
  const std::uint32_t* part_of;  //!< one a triangle
  const SurfacePart* parts;
};

//! How a mesh looks where it is placed.
struct SurfaceLook {
  Surface surface;
  Vector3<float> factor;  //!< on all its colours
  float columns, rows;    //!< of a checkerboard; 0: none
  float dark;             //!< factor on the light of every other field
  bool lit;               //!< it shines back the scene's light, as Lambert says
};

//! A place on a surface.
struct SurfacePlace {
  Vector3<double> normal;  //!< as its corners say, of unit length, in space
  Vector3<double> lift;    //!< from the flat triangle to the smooth surface that its normals tell of [M]
  float u, v;
  std::uint32_t part;
};

inline namespace ERGO_TARGET {

ERGO_HD Vector3<double> vector_of(const float (&v)[3]) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

ERGO_HD SurfacePlace surface_place(const Surface& surface, const PlacedMesh& mesh, std::uint32_t place, double weight_1,
                                   double weight_2) {
  const std::uint32_t triangle = mesh.tree.triangles[place];
  const SurfaceVertex* corner[3];
  for (int i = 0; i < 3; ++i) {
    corner[i] =
        surface.vertices + surface.indices[3 * static_cast<std::size_t>(triangle) + static_cast<std::size_t>(i)];
  }
  const double weight[3] = {1.0 - weight_1 - weight_2, weight_1, weight_2};
  Vector3<double> normal = {0.0, 0.0, 0.0};
  Vector3<double> flat = {0.0, 0.0, 0.0};
  double u = 0.0;
  double v = 0.0;
  for (int i = 0; i < 3; ++i) {
    normal = normal + weight[i] * vector_of(corner[i]->normal);
    flat = flat + weight[i] * vector_of(corner[i]->position);
    u += weight[i] * static_cast<double>(corner[i]->texture[0]);
    v += weight[i] * static_cast<double>(corner[i]->texture[1]);
  }
  // Onto the planes across the corners' normals, as far as they lie above (Hanika 2021).
  Vector3<double> lift = {0.0, 0.0, 0.0};
  for (int i = 0; i < 3; ++i) {
    const Vector3<double> n = vector_of(corner[i]->normal);
    lift = lift + (weight[i] * ::fmax(0.0, dot(n, vector_of(corner[i]->position) - flat))) * n;
  }
  const auto unit = [&](const Vector3<double>& w) {
    return turned_with_mesh(mesh, (1.0 / ::fmax(::sqrt(dot(w, w)), 1e-300)) * w);
  };
  return {unit(normal), mesh.size * turned_with_mesh(mesh, lift), static_cast<float>(u), static_cast<float>(v),
          surface.part_of[triangle]};
}

//! Linear light of a surface by itself, or in white light of strength 1. `footprint`: of the texture, in a pixel or less; v counts upwards.
ERGO_HD Vector3<float> surface_color(const SurfaceLook& look, const SurfacePlace& at,
                                     const OverlayFootprint& footprint) {
  const SurfacePart& part = look.surface.parts[at.part];
  Vector3<float> color = {look.factor.x * part.color.x, look.factor.y * part.color.y, look.factor.z * part.color.z};
  if (part.textured) {
    // Images repeat themselves beyond their sides.
    const auto wrapped = [](float x) { return x >= 0.0F && x <= 1.0F ? x : x - ::floorf(x); };
    const OverlayFootprint on_image = {wrapped(at.u),       1.0F - wrapped(at.v), footprint.s_along_x,
                                       footprint.s_along_y, -footprint.t_along_x, -footprint.t_along_y};
    const Quad texel = filtered_overlay(part.image, on_image);
    color = {color.x * quad_part(texel, 0), color.y * quad_part(texel, 1), color.z * quad_part(texel, 2)};
  }
  if (look.columns > 0.0F) {
    const auto cell = static_cast<long>(::floorf(at.u * look.columns)) + static_cast<long>(::floorf(at.v * look.rows));
    if ((cell & 1L) != 0) {
      color = look.dark * color;
    }
  }
  return color;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
