#include "app/commands/channels/channel_metadata.h"

#include <cmath>
#include <string>

#include "app/cli/show_loading.h"
#include "content/camera/camera_path.h"
#include "content/show/reading/motion_reader.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

//! Adds the components of a vector along e_r, e_θ and e_φ, each as an entry. `what` describes the
//! vector.
void add_vector(const std::string& name, const std::string& keyword, const std::string& what, const Vector3<double>& v,
                std::vector<MetadataEntry>& metadata) {
  metadata.push_back({name + "_r", keyword + "_R", v.x, what + ", along e_r"});
  metadata.push_back({name + "_theta", keyword + "_T", v.y, what + ", along e_theta"});
  metadata.push_back({name + "_phi", keyword + "_P", v.z, what + ", along e_phi"});
}

void add_observer(const Show& show, bool moves_as_given, const EyeCamera& eye, std::vector<MetadataEntry>& metadata) {
  const bool in_rain = eye.motion == ObserverMotion::rain || eye.motion == ObserverMotion::rain_boost;
  metadata.push_back({"observer", "OBSERVER",
                      std::string(moves_as_given ? "velocity" : motion_name(show.camera.motion)),
                      "motion of the camera"});
  metadata.push_back({"velocity_frame", "VELFRAME", std::string(in_rain ? "rain" : "zamo"), "frame of the velocity"});
  const bool at_rest = eye.motion == ObserverMotion::rain || eye.motion == ObserverMotion::zamo;
  add_vector("velocity", "VEL", "velocity / c", at_rest ? Vector3<double>{} : eye.velocity, metadata);
}

//! Rounds a component of a unit vector to 1e-15, which removes the rounding errors of rotations.
double unturned(double component) { return std::round(1e15 * component) / 1e15 + 0.0; }

void add_axes(const EyeCamera& eye, std::vector<MetadataEntry>& metadata) {
  const auto column = [&](int j, double sign) {
    return Vector3<double>{unturned(sign * eye.frame_from_view[0][j]), unturned(sign * eye.frame_from_view[1][j]),
                           unturned(sign * eye.frame_from_view[2][j])};
  };
  add_vector("forward", "FWD", "axis of the view forward", column(2, -1.0), metadata);
  add_vector("right", "RIGHT", "axis of the view to the right", column(0, 1.0), metadata);
  add_vector("up", "UP", "axis of the view upwards", column(1, 1.0), metadata);
}

void add_projection(const Show& show, const Projection& projection, std::vector<MetadataEntry>& metadata) {
  metadata.push_back(
      {"projection", "PROJECT", view_projection_names[static_cast<std::size_t>(show.view.projection)], ""});
  switch (projection.kind) {
    case ProjectionKind::dome_fisheye:
      metadata.push_back(
          {"fov_deg", "FOV", 2.0 * radian_deg * projection.dome.lens.half_angle, "[deg] across the image circle"});
      metadata.push_back({"tilt_deg", "TILT", show.view.tilt_deg, "[deg] tilt of the dome to the front"});
      break;
    case ProjectionKind::pinhole:
      metadata.push_back(
          {"half_width", "HALFWID", projection.pinhole.half_width, "tangent of half the horizontal angle"});
      metadata.push_back(
          {"half_height", "HALFHGT", projection.pinhole.half_height, "tangent of half the vertical angle"});
      break;
    case ProjectionKind::cylinder:
      metadata.push_back({"fov_deg", "FOV", 2.0 * radian_deg * projection.cylinder.half_azimuth, "[deg] of azimuth"});
      break;
    case ProjectionKind::equirectangular:
      if (!wraps_around(projection)) {
        metadata.push_back(
            {"fov_deg", "FOV", 2.0 * radian_deg * projection.equirectangular.half_azimuth, "[deg] of azimuth"});
      }
      break;
    default:
      break;
  }
  metadata.push_back({"from_outside", "MIRRORED", std::string(show.view.from_outside ? "true" : "false"), ""});
}

}  // namespace

std::vector<MetadataEntry> channel_metadata(const Show& show, int frame, const ChannelScene& scene) {
  const EyeCamera& eye = scene.eye;
  const double time_s = frame_time_s(show, frame);
  std::vector<MetadataEntry> metadata = {
      {"version", "CREATOR", std::string("Ergodome " ERGODOME_VERSION), "program"},
      {"show", "OBJECT", text_in(show.title, ""), "title of the show"},
      {"frame", "FRAME", frame + 1, "frame number, from 1"},
      {"time_s", "TIME", time_s, "[s] time in the show"},
      {"spin", "SPIN", eye.spacetime.spin, "a/M of the hole"},
      {"r", "CAM_R", eye.r, "[GM/c**2] Boyer-Lindquist radius"},
      {"theta_deg", "CAM_THET", radian_deg * eye.theta, "[deg] polar angle"},
      {"phi_deg", "CAM_PHI", radian_deg * eye.phi, "[deg] azimuth"},
  };
  add_observer(show, camera_pose(show, time_s).velocity.has_value(), eye, metadata);
  add_axes(eye, metadata);
  add_projection(show, scene.projection, metadata);
  if (show.disk) {
    metadata.push_back({"disk_inner", "DISK_IN", scene.disk_inner, "[GM/c**2] inner edge of the disk"});
    metadata.push_back({"disk_outer", "DISK_OUT", scene.disk_outer, "[GM/c**2] outer edge of the disk"});
  }
  metadata.push_back({"spin_axis_ra_deg", "SPIN_RA", show.sky.spin_axis_ra_deg, "[deg] J2000, of the spin axis"});
  metadata.push_back({"spin_axis_dec_deg", "SPIN_DEC", show.sky.spin_axis_dec_deg, "[deg] J2000, of the spin axis"});
  metadata.push_back({"method", "METHOD", std::string("taylor, order 20, double"), "ray tracing method"});
  metadata.push_back({"tolerance", "TOLERANC", channel_tolerance, "local error per step"});
  metadata.push_back({"step_limit", "STEPLIM", channel_step_limit, "maximum number of steps of a ray"});
  return metadata;
}

}  // namespace ergodome
