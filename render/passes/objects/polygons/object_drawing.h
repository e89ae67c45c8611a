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
#include "render/passes/objects/polygons/turning_view.h"

namespace ergodome {

//! An object at one instant.
struct PlacedObject {
  const ObjectSettings* settings;
  std::size_t mesh;  //!< which of the meshes it has
  ObjectPlacement placement;
};

//! A rectangle of a picture, from its top left corner.
struct PictureTile {
  int left_px;
  int top_px;
  int width_px;
  int height_px;
};

//! Draws objects in the current OpenGL context.
class ObjectDrawing {
 public:
  //! Throws Error where the driver refuses.
  explicit ObjectDrawing(const std::vector<TriangleMesh>& meshes);
  ~ObjectDrawing();
  ObjectDrawing(const ObjectDrawing&) = delete;
  ObjectDrawing& operator=(const ObjectDrawing&) = delete;

  //! What is drawn: objects as an eye sees them, all within a range of radii.
  struct Scene {
    ObjectView view;             //!< of a turning eye, the head's
    const TurningView* turning;  //!< nullptr: the eye stands still
    double beside;               //!< how far to the right of the head it is in the model `flat` [M]; else 0
    std::span<const PlacedObject> objects;
    std::optional<PointLight> light;
    RadialRange range;
  };

  //! Draws a tile of a picture: light times coverage, and coverage, four floats a pixel, the bottom row first. The projection is one over
  //! which nothing jumps: whole, or a face of a cube.
  void draw(const Scene& scene, const Projection& projection, const PictureTile& tile, std::vector<float>& rgba);

 private:
  void set_tables(const Scene& scene);
  void draw_object(const Scene& scene, const PlacedObject& object) const;

  void use_program(const Scene& scene);
  void set_turning(const TurningView& turning);

  std::array<unsigned, 3>
      programs_{};     //!< by ObjectSight; the camera's made at once, so that a driver that refuses does so then
  unsigned eyes_ = 0;  //!< buffer of the uniform block of eyes that turn
  std::vector<std::unique_ptr<GlMesh>> meshes_;
  ConnectionTextures tables_;
  std::unique_ptr<ObjectTarget> target_;
};

}  // namespace ergodome
