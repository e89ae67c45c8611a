#pragma once

// The shaders of diagrams.
namespace ergodome {

//! Locations of uniforms.
enum DiagramUniform {
  //! Half width and height of the whole picture's screen; nearest and farthest depth.
  uniform_diagram_screen = 0,
  uniform_diagram_tile = 1,  //!< scale and shift from the picture's clip space to the tile's
  uniform_diagram_pixel = 2  //!< for lines: size of a width of 1 in the tile's clip space
};

extern const char* const diagram_surface_vertex_source;
extern const char* const diagram_surface_fragment_source;
extern const char* const diagram_line_vertex_source;
extern const char* const diagram_line_fragment_source;

}  // namespace ergodome
