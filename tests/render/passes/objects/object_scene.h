#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "kernels/projection/make_projection.h"
#include "kernels/spacetime/schwarzschild/apparent_position.h"
#include "render/passes/objects/object_pass.h"
#include "tests/support/gl_driver.h"

// Small scenes with objects, drawn without a sky.
namespace ergodome::test {

inline constexpr double right_angle = 0.5 * pi;

//! The angle of a pixel [rad] in which tests express differences: that of a picture with 1024
//! pixels for 25°.
inline constexpr double reference_pixel = 25.0 * one_degree / 1024.0;

inline ObjectSettings small_sphere(const Vector3<double>& position, double size) {
  ObjectSettings object;
  object.form = ObjectForm::sphere;
  object.position = position;
  object.size = size;
  // Small triangles need only coarse tessellation, which is faster to draw by the CPU.
  object.tessellation.maximum = 8.0;
  return object;
}

//! Returns a static observer on the x axis who looks in the direction `forward`, given in the rest
//! frame (e_r, e_θ, e_φ).
inline EyeCamera eye_looking(double r, const Vector3<double>& forward) {
  EyeCamera eye{};
  eye.r = r;
  eye.theta = right_angle;
  eye.motion = ObserverMotion::fixed;
  const Vector3<double> back = -1.0 * forward;
  const Vector3<double> helper =
      std::abs(forward.y) < 0.9 ? Vector3<double>{0.0, -1.0, 0.0} : Vector3<double>{0.0, 0.0, 1.0};
  Vector3<double> right = cross(helper, back);
  right = (1.0 / std::sqrt(dot(right, right))) * right;
  const Vector3<double> up = cross(back, right);
  const Vector3<double> axes[3] = {right, up, back};
  for (int i = 0; i < 3; ++i) {
    eye.frame_from_view[0][i] = axes[i].x;
    eye.frame_from_view[1][i] = axes[i].y;
    eye.frame_from_view[2][i] = axes[i].z;
  }
  return eye;
}

//! Returns the direction, in the rest frame, in which a static observer on the x axis sees the
//! image number `order` of a point, by the closed form.
inline Vector3<double> closed_form_direction(double r_observer, const Vector3<double>& position, int order) {
  const Vector3<double> d = apparent_position({r_observer, 0.0, 0.0}, position, order).direction;
  return {d.x, -d.z, d.y};
}

//! A picture of objects in front of black. Channels: red, green, blue, and the coverage of white
//! objects.
struct DrawnObjects {
  int width = 0;
  int height = 0;
  std::vector<float> rgba;

  [[nodiscard]] float at(int x, int y, int channel = 0) const {
    return rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) +
                static_cast<std::size_t>(channel)];
  }

  //! light() returns the sum of the first channel.
  double light() const {
    double sum = 0.0;
    each([&](double /*x*/, double /*y*/, double value) { sum += value; });
    return sum;
  }
  void middle(double& x_px, double& y_px) const {
    x_px = 0.0;
    y_px = 0.0;
    each([&](double x, double y, double value) {
      x_px += x * value;
      y_px += y * value;
    });
    const double sum = light();
    x_px /= sum;
    y_px /= sum;
  }
  template <class Action>
  void each(const Action& action) const {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        action(x + 0.5, y + 0.5, static_cast<double>(at(x, y)));
      }
    }
  }
};

//! Draws objects and measures their light. Skips the tests if OpenGL is not available.
class ObjectScenes : public testing::Test {
 protected:
  void SetUp() override {
    driver_was_loaded = true;
    try {
      const GlThread thread;
    } catch (const Error& problem) {
      GTEST_SKIP() << problem.what();
    }
  }

  static Show show_of(const std::vector<ObjectSettings>& objects) {
    Show show;
    show.name = "scene";
    show.objects = objects;
    return show;
  }

  static DrawnObjects draw(ObjectPass& pass, const EyeCamera& eye, const Projection& projection, double time_s = 0.0) {
    DrawnObjects drawn{projection.width_px, projection.height_px, {}};
    drawn.rgba.assign(4UL * static_cast<unsigned long>(drawn.width) * static_cast<unsigned long>(drawn.height), 0.0F);
    pass.draw(eye, projection, time_s, drawn.rgba.data());
    return drawn;
  }

  static DrawnObjects draw(const Show& show, const EyeCamera& eye, const Projection& projection) {
    ObjectPass pass(show);
    return draw(pass, eye, projection);
  }
};

}  // namespace ergodome::test
