#include "render/passes/objects/polygons/object_view.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <cmath>

#include "content/show/object_settings.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/spacetime/kerr/frame_boost.h"
#include "render/passes/objects/polygons/object_shaders.h"

namespace ergodome {

namespace {

void set_vec4(int at, double x, double y, double z, double w) {
  glUniform4f(at, static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(w));
}

void set_mat3(int at, const double (&rows)[3][3]) {
  float columns[9];
  for (int i = 0; i < 9; ++i) {
    columns[i] = static_cast<float>(rows[i % 3][i / 3]);
  }
  glUniformMatrix3fv(at, 1, GL_FALSE, columns);
}

}  // namespace

ObjectView object_view(const EyeCamera& eye) {
  if (!(eye.r > nearest_of_observers)) {
    throw Error("objects", fmt::format("cannot be drawn from inside the photon sphere (camera at r = {:.6g} M)", eye.r),
                "keep the camera at r > 3 M");
  }
  const double sine = std::sin(eye.theta);
  const double cosine = std::cos(eye.theta);
  const double sine_phi = std::sin(eye.phi);
  const double cosine_phi = std::cos(eye.phi);
  ObjectView view{};
  view.r = eye.r;
  view.axes[0] = {sine * cosine_phi, sine * sine_phi, cosine};
  view.axes[1] = {cosine * cosine_phi, cosine * sine_phi, -sine};
  view.axes[2] = {-sine_phi, cosine_phi, 0.0};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      view.view_from_frame[i][j] = eye.frame_from_view[j][i];
      view.face_from_view[i][j] = i == j ? 1.0 : 0.0;
    }
  }
  const FrameBoost boost = frame_boost(observer_velocity(eye.motion, eye.spacetime, eye.r, eye.theta, eye.velocity));
  view.boost_axis = boost.axis;
  view.boost_stretch = 1.0 / boost.stretch;
  return view;
}

void turn_to_face(Projection& projection, ObjectView& view) {
  if (projection.kind != ProjectionKind::cube) {
    return;
  }
  const double root = std::sqrt(2.0);
  const Vector3<double> forward = direction_from_cube(projection.cube, 0.0, 0.0);
  const Vector3<double> axes[3] = {root * direction_from_cube(projection.cube, 1.0, 0.0) - forward,
                                   root * direction_from_cube(projection.cube, 0.0, 1.0) - forward, -1.0 * forward};
  for (int i = 0; i < 3; ++i) {
    view.face_from_view[i][0] = axes[i].x;
    view.face_from_view[i][1] = axes[i].y;
    view.face_from_view[i][2] = axes[i].z;
  }
  projection.kind = ProjectionKind::pinhole;
  projection.pinhole = {1.0, 1.0, 0.0, 0.0};
}

void set_view(const ObjectView& view) {
  set_mat3(uniform_view_from_frame, view.view_from_frame);
  set_mat3(uniform_face_from_view, view.face_from_view);
  set_vec4(uniform_boost, view.boost_axis.x, view.boost_axis.y, view.boost_axis.z, view.boost_stretch);
}

void set_projection(const Projection& projection) {
  glUniform1i(uniform_kind, static_cast<int>(projection.kind));
  glUniform1f(uniform_mirror, static_cast<float>(-projection.left));
  const Pinhole<double>& pinhole = projection.pinhole;
  const Cylinder<double>& cylinder = projection.cylinder;
  if (projection.kind == ProjectionKind::cylinder) {
    set_vec4(uniform_screen, cylinder.half_azimuth, cylinder.half_height, 0.0, cylinder.middle_height);
  } else if (projection.kind == ProjectionKind::equirectangular) {
    set_vec4(uniform_screen, pi / projection.equirectangular.half_azimuth, 0.0, 0.0, 0.0);
  } else {
    set_vec4(uniform_screen, pinhole.half_width, pinhole.half_height, pinhole.middle_x, pinhole.middle_y);
  }
  const DomeFisheye<double>& dome = projection.dome;
  glUniform1i(uniform_law, static_cast<int>(dome.lens.law));
  set_vec4(uniform_lens, dome.tilt_sine, dome.tilt_cosine, dome.lens.half_angle, dome.lens.scale);
  const double(&f)[4] = dome.lens.coefficient;
  set_vec4(uniform_polynomial, f[0], f[1], f[2], f[3]);
  set_vec4(uniform_viewer, dome.viewer.x, dome.viewer.y, dome.viewer.z, dome.off_centre);
}

}  // namespace ergodome
