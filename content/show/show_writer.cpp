#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "content/files/toml_table.h"
#include "content/objects/object_reader.h"
#include "content/show/disk_reader.h"
#include "content/show/key_table.h"
#include "content/show/shell_reader.h"
#include "content/show/show_reader.h"
#include "content/show/show_schema.h"
#include "content/sky/map_layout_reader.h"
#include "content/timeline/timeline_writer.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

//! Converts radians to degrees, clamped to the range that the reader accepts, as rounding may
//! exceed it.
double degrees_of(double angle, double least = -1e9, double greatest = 1e9) {
  return std::clamp(angle * radian_deg, least, greatest);
}

toml::array vector_of(const Vector3<double>& v) { return toml::array{v.x, v.y, v.z}; }

void insert_motion(toml::table& table, const char* key, ObserverMotion motion, const Vector3<double>& velocity) {
  if (motion == ObserverMotion::velocity) {
    const double beta = std::min(std::sqrt(dot(velocity, velocity)), fastest_observer);
    const Vector3<double> toward = beta > 1e-100 ? (1.0 / beta) * velocity : Vector3<double>{1.0, 0.0, 0.0};
    table.insert(key, toml::table{{"beta", beta}, {"toward", vector_of(toward)}});
    return;
  }
  constexpr const char* names[] = {"zamo", "static", "geodesic", "retrograde", "rain"};
  table.insert(key, names[static_cast<int>(motion)]);
}

toml::table fall_of(const FallSettings& fall) {
  toml::table table{{"t_s", fall.time_s}, {"clock", fall.clock}, {"ease_s", fall.ease_s}};
  insert_motion(table, "velocity", fall.motion, fall.velocity);
  if (fall.until_s) {
    table.insert("until_s", *fall.until_s);
  }
  if (fall.least_r > 0.0) {
    table.insert("least_r", fall.least_r);
  }
  return table;
}

toml::table camera_of(const CameraSettings& camera) {
  toml::table table;
  insert_motion(table, "observer", camera.motion, camera.velocity);
  toml::array keys;
  for (const CameraKey& key : camera.keys) {
    toml::table each{{"t_s", key.time_s},
                     {"yaw_deg", degrees_of(key.yaw)},
                     {"pitch_deg", degrees_of(key.pitch)},
                     {"roll_deg", degrees_of(key.roll)}};
    if (!camera.fall || !falls_at(*camera.fall, key.time_s)) {
      each.insert("r", key.r);
      each.insert("theta_deg", degrees_of(key.theta, 0.0, 180.0));
      each.insert("phi_deg", degrees_of(key.phi));
    }
    if (key.velocity) {
      insert_motion(each, "velocity", ObserverMotion::velocity, *key.velocity);
    }
    if (key.look.kind == LookTarget::Kind::direction) {
      each.insert("look", vector_of(key.look.direction));
    } else {
      each.insert("look", key.look.kind == LookTarget::Kind::hole ? "hole" : "away");
    }
    if (key.hold_s > 0.0) {
      each.insert("hold_s", key.hold_s);
    }
    if (key.ease != Ease::smooth) {
      each.insert("ease", ease_names[static_cast<std::size_t>(key.ease)]);
    }
    keys.push_back(std::move(each));
  }
  table.insert("key", std::move(keys));
  if (camera.fall) {
    table.insert("fall", fall_of(*camera.fall));
  }
  return table;
}

toml::table view_of(const ViewSettings& view) {
  constexpr const char* projections[] = {"dome", "equirect", "cube", "cylinder", "pinhole"};
  constexpr const char* lenses[] = {"equidistant", "equisolid", "stereographic", "orthographic", "polynomial"};
  constexpr const char* files[] = {"cross", "strip", "faces"};
  toml::table table{{"projection", projections[static_cast<int>(view.projection)]},
                    {"fov_deg", view.field_of_view_deg},
                    {"tilt_deg", view.tilt_deg},
                    {"artistic_tilt", view.artistic_tilt},
                    {"size_px", view.size_px},
                    {"aspect", view.aspect},
                    {"from_outside", view.from_outside}};
  if (view.vignette > 0.0) {
    table.insert("vignette", view.vignette);
  }
  if (view.projection == ViewProjection::dome) {
    table.insert("lens", lenses[static_cast<int>(view.lens)]);
    if (view.lens == LensLaw::polynomial) {
      const auto& f = view.polynomial;
      table.insert("polynomial", toml::array{f[0], f[1], f[2], f[3]});
    }
    table.insert("truncate", toml::table{{"bottom", view.truncation.bottom}, {"top", view.truncation.top}});
    table.insert("viewer", vector_of(view.viewer));
  } else if (view.projection == ViewProjection::cube) {
    table.insert("cube_layout", files[static_cast<int>(view.cube_files)]);
  } else if (view.projection == ViewProjection::cylinder) {
    table.insert("height_deg", view.height_deg);
  } else if (view.frustum) {
    table.insert("frustum", toml::table{{"left_deg", view.frustum->left_deg},
                                        {"right_deg", view.frustum->right_deg},
                                        {"up_deg", view.frustum->up_deg},
                                        {"down_deg", view.frustum->down_deg}});
  }
  return table;
}

}  // namespace

std::string to_toml(const Show& show) {
  constexpr const char* methods[] = {"inverse", "gather"};
  constexpr const char* filters[] = {"ewa", "point", "polygon"};
  const bool fitted = show.sky.shift == SkyShift::blackbody_fit;
  toml::table root{{"duration_s", show.duration_s},
                   {"frame_rate_hz", show.frame_rate_hz},
                   {"camera", camera_of(show.camera)},
                   {"sky", toml::table{{"map", show.sky.map},
                                       {"stars", show.sky.stars},
                                       {"faintest_mag", show.sky.faintest_mag},
                                       {"exposure", show.sky.exposure},
                                       {"filter", filters[static_cast<int>(show.sky.filter)]},
                                       {"shift", fitted ? "blackbody_fit" : "luminance"},
                                       {"brightening", show.sky.brightening},
                                       {"spin_axis", toml::table{{"ra_deg", show.sky.spin_axis_ra_deg},
                                                                 {"dec_deg", show.sky.spin_axis_dec_deg}}}}},
                   {"stars", toml::table{{"method", methods[static_cast<int>(show.sky.star_method)]}}},
                   {"view", view_of(show.view)}};
  for (auto& [name, part] : written_keys(show_keys(), &show)) {
    root.insert(name, std::move(part));
  }
  if (!show.title.empty()) {
    add_local_text(show.title, "title", root);
  }
  if (show.sky.map_layout != MapLayout{}) {
    root["sky"].as_table()->insert("map_layout", map_layout_table(show.sky.map_layout));
  }
  if (show.disk) {
    root.insert("disk", disk_table(*show.disk));
  }
  add_objects(show, root);
  if (!show.shells.empty()) {
    root.insert("shells", shell_tables(show.shells));
  }
  add_timeline(show.timeline, root);
  std::ostringstream text;
  text << root << '\n';
  return text.str();
}

}  // namespace ergodome
