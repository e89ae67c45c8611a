#pragma once

// The shaders of diagrams.
namespace ergodome {

//! Locations of the shaders' uniforms.
enum DiagramUniform {
  //! Half width and half height of the screen of the whole picture, at depth 1; nearest and
  //! farthest depth [M].
  uniform_diagram_screen = 0,
  uniform_diagram_tile = 1,  //!< scale and shift from the picture's clip space to the tile's
  uniform_diagram_pixel = 2  //!< for lines: size of one unit of line width in the tile's clip space
};

extern const char* const diagram_surface_vertex_source;
extern const char* const diagram_surface_fragment_source;
extern const char* const diagram_line_vertex_source;
extern const char* const diagram_line_fragment_source;

}  // namespace ergodome
