#pragma once

#include <memory>
#include <vector>

#include "content/show/show.h"
#include "render/eyes/eye_camera.h"
#include "render/passes/objects/polygons/gl_thread.h"
#include "render/passes/objects/polygons/object_drawing.h"
#include "render/passes/objects/polygons/object_outline.h"

namespace ergodome {

//! Draws a show's objects over pictures of what is behind them, through OpenGL, whatever backend the pictures are of.
class ObjectPass {
 public:
  //! Loads the meshes and opens OpenGL; the show must have objects. Throws Error where a mesh cannot be read or no driver is there.
  explicit ObjectPass(const Show& show);
  ~ObjectPass();
  ObjectPass(const ObjectPass&) = delete;
  ObjectPass& operator=(const ObjectPass&) = delete;

  //! Draws over a picture in host memory: four floats a pixel. Throws Error where an object reaches into the hole at that time of the show, or the eye is
  //! inside the photon sphere.
  //!
  //! `turning`: what turns with the direction one looks at about that eye, which is then the head's; or nullptr. `beside`: how far to the right of that
  //! head an eye of the model `flat` is [M], else 0.
  void draw(const EyeCamera& eye, const Projection& projection, double time_s, float* rgba,
            const TurningView* turning = nullptr, double beside = 0.0);

  //! The objects' outlines, where they are at a time of the show.
  [[nodiscard]] std::vector<PlacedOutline> outlines(double time_s) const {
    return place_outlines(objects_, outlines_, time_s);
  }

  //! Triangles of all objects.
  [[nodiscard]] long triangle_count() const;

  //! Bytes of the meshes of a show's objects, each that several share once. Reads them; throws Error like the constructor.
  static long mesh_bytes(const Show& show);

 private:
  //! Places all objects and holds them to the radii that can be drawn.
  RadialRange place_objects(double time_s);

  std::string show_name_;
  std::vector<ObjectSettings> objects_;
  std::optional<PointLight> light_;
  std::vector<TriangleMesh> meshes_;
  std::vector<double> mesh_radii_;
  std::vector<MeshOutline> outlines_;  //!< one an object
  std::vector<PlacedObject> placed_;
  std::vector<RadialRange> ranges_;  //!< of each object, as placed
  GlThread gl_;
  std::unique_ptr<ObjectDrawing> drawing_;  //!< made and let go on that thread
};

//! The pass of a show whose objects are polygons; else none.
std::unique_ptr<ObjectPass> polygons_of(const Show& show);

}  // namespace ergodome
