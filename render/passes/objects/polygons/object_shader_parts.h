#pragma once

// GLSL functions that several shaders for objects share (object_shaders.h).
namespace ergodome {

//! Source of `look(place, direction, view, time)`: computes for a position the direction in which
//! an observer sees it, in the observer's rest frame and in the view, and the light travel time.
//! Reads the observer's table as look_up_connection() does. Define TURNING for omnidirectional
//! stereo eyes (OmniView), or BESIDE for eyes of the model `flat`; with BESIDE, `time` is the
//! position's distance from the eye in the head's flat tangent space.
extern const char* const object_sight_source;

//! Source of three functions. `clip_place(view, depth)` maps a view direction to clip coordinates.
//! `horizontal_period()` returns the distance in clip space after which directions repeat, 0 if
//! they do not. `torn_by_projection(a, b, c)` returns whether a triangle may surround a direction
//! at which the projection is discontinuous.
extern const char* const object_projection_source;

}  // namespace ergodome
