#pragma once

#include <vector>

#include "content/objects/object_settings.h"
#include "render/diagram/apparent_mesh.h"
#include "render/diagram/diagram_scene.h"

// Adds objects to a diagram.

namespace ergodome {

//! Adds an object at its position, with its own color and checkerboard; textures are omitted.
void add_solid(const ObjectSettings& object, const TriangleMesh& mesh, const ObjectPlacement& placement,
               std::vector<DiagramCorner>& corners);

//! Adds a translucent image of an object at its apparent position, in one color with the object's
//! checkerboard.
void add_veil(const ObjectSettings& object, const ApparentMesh& mesh, const Ink& ink,
              std::vector<DiagramCorner>& corners);

//! Adds a translucent object at a former position.
void add_veil(const ObjectSettings& object, const TriangleMesh& mesh, const ObjectPlacement& placement, const Ink& ink,
              std::vector<DiagramCorner>& corners);

}  // namespace ergodome
