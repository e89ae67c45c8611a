#pragma once

#include "content/show/show.h"
#include "render/diagram/diagram_scene.h"
#include "render/eyes/eye_camera.h"

// Adds hole, axes and observer to a diagram.

namespace ergodome {

//! Adds the hole and its legend line: its horizon and the photon sphere or, with spin, the equator
//! of the ergosphere.
void add_hole(Spacetime spacetime, DiagramScene& scene);

//! Adds circles around the hole in the plane z = 0 up to `extent` [M], with their radii as labels
//! at azimuth `label_azimuth` [rad], the x and y axes, and a part of the z axis.
void add_grid(double extent, double label_azimuth, DiagramScene& scene);

//! Adds the observer, and the border of the observer's view with lines of length `length` [M] to
//! its corners. A view of all directions gets one such line in its forward direction instead.
void add_observer(const ViewSettings& view, const EyeCamera& eye, double length, DiagramScene& scene);

//! Returns a round number near `about`: 1, 2 or 5 times a power of ten.
double round_step(double about);

}  // namespace ergodome
