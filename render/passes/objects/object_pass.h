#pragma once

#include <memory>
#include <vector>

#include "content/show/show.h"
#include "render/eyes/eye_camera.h"
#include "render/opengl/gl_thread.h"
#include "render/passes/objects/object_kind.h"
#include "render/passes/objects/polygons/object_drawing.h"
#include "render/passes/objects/polygons/object_outline.h"
#include "render/passes/pass.h"

namespace ergodome {

//! Draws a show's polygon objects over finished pictures, with OpenGL, independent of the backend.
class ObjectPass : public Pass {
 public:
  //! Loads the meshes and opens OpenGL; the show must have objects. Throws Error if a mesh cannot
  //! be read or there is no driver.
  explicit ObjectPass(const Show& show);
  ~ObjectPass() override;

  [[nodiscard]] const PassKind& kind() const override { return polygon_kind; }
  std::unique_ptr<PassDrawing> prepare(const EyePicture& picture) override;
  [[nodiscard]] bool serves(const Show& /*now*/, const Show& /*next*/) const override {
    return false;  // meshes are read again, as their files may have changed
  }

  //! Draws the objects over a picture in host memory: four floats per pixel. Throws Error if an
  //! object is too close to the hole at that show time, or if the eye is inside the photon sphere.
  //!
  //! `omni`: parameters of an omnidirectional stereo eye, for which `eye` is the head; otherwise
  //! nullptr. `beside`: for an eye of the model `flat`, its distance to the right of the head `eye`
  //! [M]; otherwise 0. `adds_opacity`: the fourth channel is opacity; see Picture::stars.
  void draw(const EyeCamera& eye, const Projection& projection, double time_s, float* rgba,
            const OmniView* omni = nullptr, double beside = 0.0, bool adds_opacity = false);

  //! Returns the objects' outlines at a show time.
  [[nodiscard]] std::vector<PlacedOutline> outlines(double time_s) const {
    return place_outlines(objects_, outlines_, time_s);
  }

  //! Returns the number of triangles of all objects.
  [[nodiscard]] long triangle_count() const;

  //! Returns the size of the meshes of a show's objects [bytes]; meshes that several objects share
  //! count once. Reads the meshes; throws Error like the constructor.
  static long mesh_bytes(const Show& show);

 private:
  //! Places all objects at a show time and returns their range of r [M]. Throws Error if an object
  //! extends beyond nearest_of_objects or farthest_of_objects.
  RadialRange place_objects(double time_s);

  std::string show_name_;
  std::vector<ObjectSettings> objects_;
  std::optional<PointLight> light_;
  std::vector<TriangleMesh> meshes_;
  std::vector<double> mesh_radii_;
  std::vector<MeshOutline> outlines_;  //!< one per object
  std::vector<PlacedObject> placed_;
  std::vector<RadialRange> ranges_;  //!< range of radii of each object at its current placement
  GlThread gl_;
  std::unique_ptr<ObjectDrawing> drawing_;  //!< created and destroyed on the OpenGL thread
};

}  // namespace ergodome
