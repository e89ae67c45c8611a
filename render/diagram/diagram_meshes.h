#pragma once

#include <vector>

#include "content/objects/object_settings.h"
#include "render/diagram/apparent_mesh.h"
#include "render/diagram/diagram_scene.h"

namespace ergodome {

//! Adds an object where it stands, in its own colours and with its checkerboard; pictures on it are left out.
void add_solid(const ObjectSettings& object, const TriangleMesh& mesh, const ObjectPlacement& placement,
               std::vector<DiagramCorner>& corners);

//! Adds an image of an object where it seems to be: in one colour that shows what is behind it, with the object's checkerboard.
void add_veil(const ObjectSettings& object, const ApparentMesh& mesh, const Ink& ink,
              std::vector<DiagramCorner>& corners);

//! Adds an object in the same way where it has been.
void add_veil(const ObjectSettings& object, const TriangleMesh& mesh, const ObjectPlacement& placement, const Ink& ink,
              std::vector<DiagramCorner>& corners);

}  // namespace ergodome
