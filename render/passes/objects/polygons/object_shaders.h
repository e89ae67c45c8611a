#pragma once

#include <string>

// The five shaders that draw objects: Müller, Schulz & Weiskopf (2021), section 3.2, figure 7. The
// physics is that of kernels/spacetime/schwarzschild in single precision (apparent_position.h,
// connection_table.h and tessellation.h), and the projections are those of kernels/projection.
namespace ergodome {

//! Uniform locations. Positions and directions are in the observer's rest frame, with components
//! along (e_r, e_θ, e_φ): the outward component comes first.
enum ObjectUniform : int {
  //! Mat3: from the mesh's coordinates to the rest frame, including the size.
  uniform_model = 0,
  uniform_position = 1,  //!< vec3: position of the mesh's origin relative to the hole [M]
  uniform_turn = 2,      //!< mat3: uniform_model without the size
  uniform_order = 3,     //!< int: image order, from 1
  //! Vec4: minimum and maximum of 1/r in the table, the observer's r, √(1 - 2/r) at the observer.
  uniform_table_range = 4,
  uniform_view_from_frame = 5,  //!< mat3
  //! Vec4: axis and stretch of the aberration from the rest frame at the eye (e_r, e_θ, e_φ) to the
  //! frame of the moving observer.
  uniform_boost = 6,
  uniform_kind = 7,    //!< int: ProjectionKind
  uniform_mirror = 8,  //!< float: -1 for a picture as seen from outside, otherwise 1
  //! Vec4: half sizes and center of a flat screen or a cylinder; x of an equirectangular picture: a
  //! whole turn over its width.
  uniform_screen = 9,
  uniform_law = 10,         //!< int: LensLaw
  uniform_lens = 11,        //!< vec4: sine and cosine of the dome's tilt, half angle and scale of the lens
  uniform_polynomial = 12,  //!< vec4: coefficients of the polynomial lens law
  uniform_viewer = 13,      //!< vec4: position in the dome [radii], and 1 if that is not its center
  //! Vec4: the paper's MaxTessLevel, a and b (eqs. 18 and 19), and the factor by which a triangle
  //! must appear enlarged to count as torn by the hole.
  uniform_tessellation = 14,
  uniform_color = 15,              //!< vec3
  uniform_checker = 16,            //!< vec3: columns, rows, dark; no checker if columns is 0
  uniform_textured = 17,           //!< int: 1 if this part of the mesh has an image
  uniform_light = 18,              //!< vec4: position and strength; the surface is emissive if the strength is 0
  uniform_light_table_range = 19,  //!< vec4: like uniform_table_range, for the light
  //! Int: number of image orders in the observer's table; the light's table has two.
  uniform_table_orders = 20,
  uniform_table_observers = 21,  //!< vec2: minimum and maximum of the observers' 1/r in the table
  //! Vec4: ODS eyes as in OmniCameraOf: offset, inverse of the convergence distance, start of the
  //! fade, scale of the fade.
  uniform_omni = 22,
  uniform_inverse_reach = 23,   //!< float: 1 / radius within which the polynomials of ODS eyes are valid [1/M]
  uniform_degree = 24,          //!< int: degree of the polynomials
  uniform_face_from_view = 25,  //!< mat3
  uniform_beside = 26,          //!< float: distance of an eye of the model `flat` to the right of the head [M]
};

//! Texture units: the observer's table, the light's table, and the mesh's image.
inline constexpr int unit_table = 0;
inline constexpr int unit_light_table = 1;
inline constexpr int unit_image = 2;

//! Uniform block: polynomials of omnidirectional stereo eyes (OmniView).
inline constexpr int block_eyes = 0;

//! The kind of eye that sees the positions: a camera, an omnidirectional stereo eye, or an eye of
//! the model `flat` beside a head whose lens both eyes use. Each variant of the shaders is compiled
//! separately, without the uniforms of the others.
enum class ObjectSight { camera, omni, beside };

std::string object_vertex_source();
std::string object_control_source(ObjectSight sight);
std::string object_evaluation_source(ObjectSight sight);
std::string object_geometry_source();
std::string object_fragment_source();

}  // namespace ergodome
