#pragma once

#include <string>

// The five shaders that draw objects: Müller, Schulz & Weiskopf (2021), section 3.2, figure 7. The physics is that of kernels/schwarzschild in
// single precision: apparent_place.h, connection_table.h and tessellation.h, and the projections of kernels/projection.
namespace ergodome {

//! Where shaders have their uniforms. Places and directions are in the observer's rest frame, parts along (e_r, e_θ, e_φ): what is outward
//! from the hole comes first.
enum ObjectUniform : int {
  uniform_model = 0,            //!< mat3: from the mesh to that frame, with the size
  uniform_position = 1,         //!< vec3: of the mesh's middle [M]
  uniform_turn = 2,             //!< mat3: the same without the size
  uniform_order = 3,            //!< int: from 1 on
  uniform_table_range = 4,      //!< vec4: least and greatest 1/r, the observer's r, √(1 - 2/r) there
  uniform_view_from_frame = 5,  //!< mat3
  uniform_boost = 6,            //!< vec4: axis and stretch of the aberration from the rest frame to the observer's own
  uniform_kind = 7,             //!< int: ProjectionKind
  uniform_mirror = 8,           //!< float: -1 for a picture as seen from outside
  uniform_screen = 9,           //!< vec4: halves and middle of a flat screen or a cylinder
  uniform_law = 10,             //!< int: LensLaw
  uniform_lens = 11,            //!< vec4: sine and cosine of the tilt, half angle, scale
  uniform_polynomial = 12,      //!< vec4
  uniform_viewer = 13,          //!< vec4: on the dome, and 1 where that is not its middle
  uniform_tessellation = 14,    //!< vec4: MaxTessLevel, a, b, torn
  uniform_color = 15,           //!< vec3
  uniform_checker = 16,         //!< vec3: columns, rows, dark; no columns: none
  uniform_textured = 17,        //!< int
  uniform_light = 18,           //!< vec4: place and strength; no strength: the surface shines by itself
  uniform_light_table_range = 19,  //!< vec4: as of the observer
  uniform_table_orders = 20,       //!< int: of the observer's table; that of the light has two
  uniform_table_observers = 21,    //!< vec2: least and greatest 1/r of observers that the table is for
  uniform_turning =
      22,  //!< vec4: of eyes that turn, as OmniCameraOf: offset, inverse convergence, where the fade begins, its scale
  uniform_inverse_reach = 23,   //!< float
  uniform_degree = 24,          //!< int: of the polynomials
  uniform_face_from_view = 25,  //!< mat3
  uniform_beside = 26,          //!< float: how far to the right of the head an eye of the model `flat` is [M]
};

//! Texture units: the observer's table, the light's, and the mesh's image.
inline constexpr int unit_table = 0;
inline constexpr int unit_light_table = 1;
inline constexpr int unit_image = 2;

//! Uniform block: polynomials of eyes that turn (TurningView).
inline constexpr int block_eyes = 0;

//! How places are seen; each is compiled apart, with no uniforms of the others: by a camera, by eyes that turn with the direction one looks at,
//! by an eye beside a head through whose lens both see.
enum class ObjectSight { camera, turning, beside };

std::string object_vertex_source();
std::string object_control_source(ObjectSight sight);
std::string object_evaluation_source(ObjectSight sight);
std::string object_geometry_source();
std::string object_fragment_source();

}  // namespace ergodome
