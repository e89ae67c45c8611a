#pragma once

#include <cstdint>

#include "kernels/core/vector3.h"
#include "kernels/objects/placed_mesh.h"
#include "kernels/overlay/overlay_texture.h"

// Materials and textures of meshes, and the light of a point on them.
namespace ergodome {

//! A vertex of a surface, which several triangles may share as a corner.
struct SurfaceVertex {
  float position[3];
  float normal[3];  //!< of unit length, outwards
  //! u to the right, v upwards; the image, or one checkerboard, is 0 to 1.
  float texture[2];
  float color[3] = {1.0F, 1.0F, 1.0F};  //!< linear light; multiplies the color of the SurfacePart
};

//! How an image continues beyond its sides.
enum class TextureWrap : std::uint8_t { repeat, clamp, mirror };

//! The triangles of a surface that share a material.
struct SurfacePart {
  Vector3<float> color;  //!< linear light; multiplies the image
  bool textured;
  TextureWrap wrap_u, wrap_v;
  OverlayTexture image;
};

//! A mesh's triangles with their materials.
struct Surface {
  const SurfaceVertex* vertices;
  const std::uint32_t* indices;  //!< three per triangle
  const std::uint32_t* part_of;  //!< one per triangle
  const SurfacePart* parts;
};

//! How a placed mesh looks.
struct SurfaceAppearance {
  Surface surface;
  Vector3<float> factor;  //!< multiplies all colors of the surface
  float columns, rows;    //!< number of columns and rows of a checkerboard; 0: none
  float dark;             //!< factor on the light of every other field
  bool lit;               //!< reflects the scene's light by Lambert's law
};

//! A point of a surface.
struct SurfacePoint {
  Vector3<double> normal;  //!< unit normal in space, interpolated from the triangle's corners
  //! Vector from the flat triangle to the smooth surface that the corners' normals describe [M].
  Vector3<double> lift;
  float u, v;
  Vector3<float> color;  //!< color interpolated from the triangle's corners
  std::uint32_t part;
};

inline namespace ERGO_TARGET {

ERGO_HD Vector3<double> vector_of(const float (&v)[3]) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

ERGO_HD SurfacePoint surface_point(const Surface& surface, const PlacedMesh& mesh, std::uint32_t tree_index,
                                   double weight_1, double weight_2) {
  const std::uint32_t triangle = mesh.tree.triangles[tree_index];
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
  Vector3<float> color = {0.0F, 0.0F, 0.0F};
  for (int i = 0; i < 3; ++i) {
    const float(&own)[3] = corner[i]->color;
    color = color + static_cast<float>(weight[i]) * Vector3<float>{own[0], own[1], own[2]};
    normal = normal + weight[i] * vector_of(corner[i]->normal);
    flat = flat + weight[i] * vector_of(corner[i]->position);
    u += weight[i] * static_cast<double>(corner[i]->texture[0]);
    v += weight[i] * static_cast<double>(corner[i]->texture[1]);
  }
  // Projects the point onto the planes perpendicular to the corners' normals, as far as these lie
  // above the triangle (Hanika 2021).
  Vector3<double> lift = {0.0, 0.0, 0.0};
  for (int i = 0; i < 3; ++i) {
    const Vector3<double> n = vector_of(corner[i]->normal);
    lift = lift + (weight[i] * ::fmax(0.0, dot(n, vector_of(corner[i]->position) - flat))) * n;
  }
  const auto unit = [&](const Vector3<double>& w) {
    return turned_with_mesh(mesh, (1.0 / ::fmax(::sqrt(dot(w, w)), 1e-300)) * w);
  };
  return {unit(normal),
          mesh.size * turned_with_mesh(mesh, lift),
          static_cast<float>(u),
          static_cast<float>(v),
          color,
          surface.part_of[triangle]};
}

//! Position on the image, 0 to 1, that belongs to a texture coordinate, and the sign that
//! derivatives along the coordinate get: -1 where the image is repeated as its mirror image,
//! otherwise 1.
struct WrappedTexture {
  float at, step;
};

ERGO_HD WrappedTexture wrapped_texture(float x, TextureWrap wrap) {
  if (x >= 0.0F && x <= 1.0F) {
    return {x, 1.0F};
  }
  if (wrap == TextureWrap::clamp) {
    return {x < 0.0F ? 0.0F : 1.0F, 1.0F};
  }
  if (wrap == TextureWrap::repeat) {
    return {x - ::floorf(x), 1.0F};
  }
  const float there_and_back = x - 2.0F * ::floorf(0.5F * x);
  return there_and_back <= 1.0F ? WrappedTexture{there_and_back, 1.0F} : WrappedTexture{2.0F - there_and_back, -1.0F};
}

//! Returns the linear light of a surface: its own light if it is not lit, otherwise the light that
//! it reflects under white light of strength 1. `footprint`: that of a pixel, or of a smaller area,
//! on the texture; its v counts upwards.
ERGO_HD Vector3<float> surface_color(const SurfaceAppearance& appearance, const SurfacePoint& at,
                                     const OverlayFootprint& footprint) {
  const SurfacePart& part = appearance.surface.parts[at.part];
  Vector3<float> color = {appearance.factor.x * part.color.x * at.color.x,
                          appearance.factor.y * part.color.y * at.color.y,
                          appearance.factor.z * part.color.z * at.color.z};
  if (part.textured) {
    const WrappedTexture u = wrapped_texture(at.u, part.wrap_u);
    const WrappedTexture v = wrapped_texture(at.v, part.wrap_v);
    const OverlayFootprint on_image = {u.at,
                                       1.0F - v.at,
                                       u.step * footprint.s_along_x,
                                       u.step * footprint.s_along_y,
                                       -v.step * footprint.t_along_x,
                                       -v.step * footprint.t_along_y};
    const Quad texel = filtered_overlay(part.image, on_image);
    color = {color.x * quad_part(texel, 0), color.y * quad_part(texel, 1), color.z * quad_part(texel, 2)};
  }
  if (appearance.columns > 0.0F) {
    const auto cell =
        static_cast<long>(::floorf(at.u * appearance.columns)) + static_cast<long>(::floorf(at.v * appearance.rows));
    if ((cell & 1L) != 0) {
      color = appearance.dark * color;
    }
  }
  return color;
}

}  // namespace ERGO_TARGET
}  // namespace ergodome
