#pragma once

// GLSL functions that several shaders for objects share (object_shaders.h).
namespace ergodome {

//! `look(place, direction, view, time)`: computes the direction of a position in the observer's
//! rest frame and in the view, and the light travel time, from the observer's table as in
//! look_up_connection(). Define TURNING for omnidirectional stereo eyes (TurningView); without it
//! there is no overhead for them.
extern const char* const object_sight_source;

//! `clip_place(view, depth)`: maps a view direction to clip coordinates. `horizontal_period()`:
//! distance in clip space after which directions repeat, 0 if they do not. `torn_by_projection(a,
//! b, c)`: returns whether a triangle surrounds a point at which the projection is discontinuous.
extern const char* const object_projection_source;

}  // namespace ergodome
