#pragma once

// Parts that several of the shaders for objects have (render/objects/object_shaders.h).
namespace ergodome {

//! `look(place, direction, view, time)`: in which direction of the observer's rest frame and of the view a place is seen, and how long its light
//! takes, by the observer's table as look_up_connection() reads it. With TURNING for eyes that turn (TurningView), without for one that does not, which
//! pays nothing for them.
extern const char* const object_sight_source;

//! `clip_place(view, depth)`: where a view direction comes to lie in the picture, for the rasterizer; `horizontal_period()`: how far
//! apart in it the same direction comes again, 0: nowhere; `torn_by_projection(a, b, c)`: whether a triangle lies about a place that a
//! projection tears.
extern const char* const object_projection_source;

}  // namespace ergodome
