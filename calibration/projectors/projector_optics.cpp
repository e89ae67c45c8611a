#include "calibration/projectors/projector_optics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kernels/core/angles.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

double length(const Vector3<double>& v) { return std::sqrt(dot(v, v)); }

Vector3<double> normalized(const Vector3<double>& v) { return (1.0 / length(v)) * v; }

//! Returns a unit vector perpendicular to another vector.
Vector3<double> across(const Vector3<double>& v) {
  const Vector3<double> other = std::abs(v.x) < 0.7 ? Vector3<double>{1.0, 0.0, 0.0} : Vector3<double>{0.0, 1.0, 0.0};
  return normalized(cross(v, other));
}

FisheyeLens<double> law_of(const ProjectorFisheye& lens) {
  double coefficient[4] = {0.0, 0.0, 0.0, 0.0};
  std::copy_n(lens.polynomial.begin(), std::min<std::size_t>(lens.polynomial.size(), 4), coefficient);
  return make_fisheye_lens(lens.polynomial.empty() ? LensLaw::equidistant : LensLaw::polynomial,
                           one_degree * lens.field_of_view_deg, coefficient);
}

}  // namespace

ProjectorOptics::ProjectorOptics(const DomeSetup& setup, const ProjectorSetup& projector)
    : location_(location_of(projector)),
      dome_radius_m_(setup.radius_m),
      zenith_{0.0, std::cos(one_degree * setup.tilt_deg), -std::sin(one_degree * setup.tilt_deg)},
      position_m_(projector.position_m),
      axes_(axes_of(projector.orientation)),
      aspect_(static_cast<double>(projector.width_px) / projector.height_px),
      longer_side_px_(std::max(projector.width_px, projector.height_px)),
      mirror_(projector.mirror) {
  if (const auto* const flat = std::get_if<Frustum>(&projector.lens)) {
    frustum_ = *flat;
  } else if (const auto* const fisheye = std::get_if<ProjectorFisheye>(&projector.lens)) {
    fisheye_ = *fisheye;
    law_ = law_of(*fisheye);
  } else {
    throw Error(location_, "has no lens, so the direction of its light is unknown",
                "give it a frustum or a fisheye, position_m and its angles");
  }
  if (outside() && dot(position_m_, zenith_) > 0.0) {
    throw Error(
        location_, "is outside the dome, whose shell blocks its light",
        fmt::format(
            "correct its position_m, in meters from the dome's center: inside is within {:g} m, and a projector "
            "outside must be below the rim",
            dome_radius_m_));
  }
}

bool ProjectorOptics::outside() const { return length(position_m_) >= dome_radius_m_; }

//! Returns true if light in this direction (of unit length) from the projector meets the dome's
//! shell from outside.
bool ProjectorOptics::is_stopped_outside(const Vector3<double>& way) const {
  if (!outside()) {
    return false;
  }
  const double along = dot(position_m_, way);
  const double room = along * along - dot(position_m_, position_m_) + dome_radius_m_ * dome_radius_m_;
  const double distance = -along - std::sqrt(std::max(room, 0.0));
  return room > 0.0 && distance > 0.0 && dot(position_m_ + distance * way, zenith_) > 0.0;
}

double ProjectorOptics::circle_radius(const RasterPosition& position, double& to_right, double& upwards) const {
  // Position relative to the fisheye's axis, in half-widths of the raster.
  to_right = 2.0 * position.x - 1.0 - fisheye_->offset_x;
  upwards = (1.0 - 2.0 * position.y - fisheye_->offset_y) / aspect_;
  const double radius = std::hypot(to_right, upwards);
  return fisheye_->polynomial.empty() ? radius * aspect_ / fisheye_->circle : radius;
}

Vector3<double> ProjectorOptics::lens_direction(const RasterPosition& position) const {
  if (!fisheye_) {
    return normalized(direction_from_raster(axes_, frustum_, position.x, position.y));
  }
  double to_right = 0.0;
  double upwards = 0.0;
  const double radius = circle_radius(position, to_right, upwards);
  double slope = 0.0;
  double angle = radius * law_.half_angle;
  if (law_.law == LensLaw::polynomial) {
    angle = radius < law_.rim ? polynomial_angle(law_, radius) : law_.half_angle;
    polynomial_radius(law_, law_.half_angle, slope);
    angle += std::max(radius - law_.rim, 0.0) / slope;
  }
  const double scale = std::hypot(to_right, upwards);
  const double sine = scale > 0.0 ? std::sin(angle) / scale : 0.0;
  return std::cos(angle) * axes_.forward + (sine * to_right) * axes_.right + (sine * upwards) * axes_.up;
}

std::optional<RasterPosition> ProjectorOptics::lens_position(const Vector3<double>& direction) const {
  const double to_right = dot(direction, axes_.right);
  const double upwards = dot(direction, axes_.up);
  const double forward = dot(direction, axes_.forward);
  if (!fisheye_) {
    if (!(forward > 0.0)) {
      return std::nullopt;
    }
    const double left = std::tan(one_degree * frustum_.left_deg);
    const double right = std::tan(one_degree * frustum_.right_deg);
    const double up = std::tan(one_degree * frustum_.up_deg);
    const double down = std::tan(one_degree * frustum_.down_deg);
    return RasterPosition{(to_right / forward - left) / (right - left), (upwards / forward - up) / (down - up)};
  }
  const double sine = std::hypot(to_right, upwards);
  double radius = 0.0;
  if (!lens_radius(law_, forward, sine, radius)) {
    return std::nullopt;
  }
  const double half_widths = fisheye_->polynomial.empty() ? radius * fisheye_->circle / aspect_ : radius;
  const double scale = sine > 0.0 ? half_widths / sine : 0.0;
  return RasterPosition{0.5 * (scale * to_right + fisheye_->offset_x + 1.0),
                        0.5 * (1.0 - scale * upwards * aspect_ - fisheye_->offset_y)};
}

std::optional<Vector3<double>> ProjectorOptics::sphere_point(const Vector3<double>& from,
                                                             const Vector3<double>& way) const {
  const double along = dot(from, way);
  const double room = along * along - dot(from, from) + dome_radius_m_ * dome_radius_m_;
  const double distance = std::sqrt(std::max(room, 0.0)) - along;
  if (!(room >= 0.0) || !(distance > 0.0)) {
    return std::nullopt;
  }
  return from + distance * way;
}

std::optional<Vector3<double>> ProjectorOptics::dome_point(const RasterPosition& position) const {
  const Vector3<double> way = lens_direction(position);
  if (is_stopped_outside(way)) {
    return std::nullopt;
  }
  if (!mirror_) {
    return sphere_point(position_m_, way);
  }
  const Vector3<double> from = position_m_ - mirror_->position_m;
  const double along = dot(from, way);
  const double room = along * along - dot(from, from) + mirror_->radius_m * mirror_->radius_m;
  const double distance = -along - std::sqrt(std::max(room, 0.0));
  if (!(room > 0.0) || !(distance > 0.0)) {
    return std::nullopt;
  }
  const Vector3<double> met = from + distance * way;
  const Vector3<double> normal = normalized(met);
  return sphere_point(mirror_->position_m + met, way - (2.0 * dot(way, normal)) * normal);
}

//! Returns the point of the mirror at which light from the projector to `point` is reflected
//! (Alhazen's problem). The solution is in the plane of projector, point and mirror center. There,
//! the directions to projector and point have opposite components along the mirror's surface.
Vector3<double> ProjectorOptics::mirror_point(const Vector3<double>& point) const {
  const Vector3<double> from = position_m_ - mirror_->position_m;
  const Vector3<double> to = point - mirror_->position_m;
  const Vector3<double> first = normalized(from);
  const Vector3<double> beside = to - dot(to, first) * first;
  const Vector3<double> second = length(beside) > 1e-12 * length(to) ? normalized(beside) : across(first);
  double low = 0.0;
  double high = std::atan2(dot(to, second), dot(to, first));
  Vector3<double> met{};
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    const double angle = 0.5 * (low + high);
    const Vector3<double> normal = std::cos(angle) * first + std::sin(angle) * second;
    const Vector3<double> along = std::cos(angle) * second - std::sin(angle) * first;
    met = mirror_->radius_m * normal;
    const double rest = dot(normalized(from - met), along) + dot(normalized(to - met), along);
    (rest > 0.0 ? low : high) = angle;
  }
  return mirror_->position_m + met;
}

std::optional<RasterPosition> ProjectorOptics::raster_position(const Vector3<double>& point) const {
  const Vector3<double> met = mirror_ ? mirror_point(point) : point;
  const Vector3<double> last = point - (mirror_ ? met : position_m_);
  if (!(dot(last, point) > 0.0)) {
    return std::nullopt;  // light that comes from outside meets no point, because the sphere is lit from inside
  }
  if (mirror_ && !(dot(met - mirror_->position_m, position_m_ - met) > 0.0)) {
    return std::nullopt;
  }
  const Vector3<double> way = normalized(met - position_m_);
  if (is_stopped_outside(way)) {
    return std::nullopt;
  }
  const std::optional<RasterPosition> position = lens_position(way);
  return position && depth(*position) > 0.0 ? position : std::nullopt;
}

double ProjectorOptics::depth(const RasterPosition& position) const {
  const auto inside = [](double t) { return t > 0.0 && t < 1.0 ? 4.0 * t * (1.0 - t) : 0.0; };
  double depth = inside(position.x) * inside(position.y);
  if (fisheye_) {
    double to_right = 0.0;
    double upwards = 0.0;
    const double part = circle_radius(position, to_right, upwards) / law_.rim;
    depth *= std::max(1.0 - part * part, 0.0);
  }
  return depth;
}

double ProjectorOptics::spread_m2(const RasterPosition& position) const {
  // Step of the difference quotients, in widths or heights of the raster. Their error is far below
  // a pixel.
  constexpr double step = 1e-4;
  const auto here = dome_point(position);
  if (!here) {
    return 0.0;
  }
  // Near the edge of the lit sphere, a one-sided difference is used.
  const auto rate = [&](double dx, double dy) {
    const auto before = dome_point({position.x - dx, position.y - dy});
    const auto after = dome_point({position.x + dx, position.y + dy});
    const double way = (before ? step : 0.0) + (after ? step : 0.0);
    return way > 0.0 ? (1.0 / way) * (after.value_or(*here) - before.value_or(*here)) : Vector3<double>{0.0, 0.0, 0.0};
  };
  return length(cross(rate(step, 0.0), rate(0.0, step)));
}

}  // namespace ergodome
