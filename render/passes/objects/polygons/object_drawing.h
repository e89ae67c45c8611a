#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "content/objects/object_motion.h"
#include "render/passes/objects/polygons/connection_textures.h"
#include "render/passes/objects/polygons/gl_mesh.h"
#include "render/passes/objects/polygons/object_target.h"
#include "render/passes/objects/polygons/object_view.h"
#include "render/passes/objects/polygons/omni_view.h"

namespace ergodome {

//! An object at one instant.
struct PlacedObject {
  const ObjectSettings* settings;
  std::size_t mesh;  //!< index of the object's mesh
  ObjectPlacement placement;
};

//! A rectangle of a picture; coordinates start at the picture's top left corner.
struct PictureTile {
  int left_px;
  int top_px;
  int width_px;
  int height_px;
};

//! Draws objects in the current OpenGL context.
class ObjectDrawing {
 public:
  //! Throws Error if the driver fails.
  explicit ObjectDrawing(const std::vector<TriangleMesh>& meshes);
  ~ObjectDrawing();
  ObjectDrawing(const ObjectDrawing&) = delete;
  ObjectDrawing& operator=(const ObjectDrawing&) = delete;

  //! A set of objects and the eye that sees them; all objects are within a range of radii.
  struct Scene {
    //! Parameters of the eye; of the head, for an omnidirectional stereo eye.
    ObjectView view;
    const OmniView* omni;  //!< nullptr unless the eye is omnidirectional
    //! Distance of an eye of the model `flat` to the right of the head [M]; otherwise 0.
    double beside;
    std::span<const PlacedObject> objects;
    std::optional<PointLight> light;
    RadialRange range;
  };

  //! Draws a tile of a picture: light times coverage, and coverage; four floats per pixel, bottom
  //! row first. The projection must be continuous: a whole picture, or a face of a cube.
  void draw(const Scene& scene, const Projection& projection, const PictureTile& tile, std::vector<float>& rgba);

 private:
  void set_tables(const Scene& scene);
  void draw_object(const Scene& scene, const PlacedObject& object) const;

  void use_program(const Scene& scene);
  void set_omni_view(const OmniView& omni);

  //! Shader program for each ObjectSight; the one for cameras is linked immediately, so that driver
  //! errors appear early.
  std::array<unsigned, 3> programs_{};
  unsigned eyes_ = 0;  //!< uniform buffer of omnidirectional stereo eyes
  std::vector<std::unique_ptr<GlMesh>> meshes_;
  ConnectionTextures tables_;
  std::unique_ptr<ObjectTarget> target_;
};

}  // namespace ergodome
