#pragma once

#include "content/show/show.h"
#include "render/diagram/diagram_scene.h"
#include "render/eyes/eye_camera.h"

namespace ergodome {

//! Adds the hole: its horizon, the photon sphere or, where it spins, the ergosphere's equator.
void add_hole(double spin, DiagramScene& scene);

//! Adds circles about the hole in the plane z = 0 as far as `extent` with their radii, the axes x and y, and a piece of z [M].
void add_grid(double extent, double label_azimuth, DiagramScene& scene);

//! Adds the observer and the borders of its view, drawn `length` far [M].
void add_observer(const ViewSettings& view, const EyeCamera& eye, double length, DiagramScene& scene);

//! A round number near `about`: 1, 2 or 5 times a power of ten.
double round_step(double about);

}  // namespace ergodome
