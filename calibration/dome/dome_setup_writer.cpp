#include <toml++/toml.h>

#include <sstream>

#include "calibration/dome/dome_setup.h"
#include "content/files/atomic_file.h"

namespace ergodome {

namespace {

toml::array list_of(const Vector3<double>& v) { return toml::array{v.x, v.y, v.z}; }

void insert_lens(toml::table& table, const Lens& lens) {
  if (const auto* const frustum = std::get_if<Frustum>(&lens)) {
    table.insert("frustum", toml::table{{"left_deg", frustum->left_deg},
                                        {"right_deg", frustum->right_deg},
                                        {"up_deg", frustum->up_deg},
                                        {"down_deg", frustum->down_deg}});
  } else if (const auto* const fisheye = std::get_if<ProjectorFisheye>(&lens)) {
    toml::table each{{"fov_deg", fisheye->field_of_view_deg},
                     {"offset", toml::array{fisheye->offset_x, fisheye->offset_y}}};
    if (fisheye->polynomial.empty()) {
      each.insert("circle", fisheye->circle);
    } else {
      toml::array polynomial;
      for (const double coefficient : fisheye->polynomial) {
        polynomial.push_back(coefficient);
      }
      each.insert("polynomial", std::move(polynomial));
    }
    table.insert("fisheye", std::move(each));
  }
}

toml::table warp_of(const WarpFile& warp) {
  toml::table table{{"file", warp.file}, {"format", word_of(warp.format)}};
  if (warp.format == WarpFormat::bourke) {
    table.insert("x_range", warp.x_to_one ? "one" : "aspect");
  } else if (warp.format == WarpFormat::pfm || warp.format == WarpFormat::mpcdi) {
    table.insert("rows", warp.rows == RowOrder::bottom_up ? "bottom_up" : "top_down");
  }
  if (warp.format == WarpFormat::pfm) {
    table.insert("texture", warp.texture == TextureDirection::downwards ? "downwards" : "upwards");
  }
  if (!warp.region.empty()) {
    table.insert("region", warp.region);
  }
  if (warp.source == WarpSource::lens_picture) {
    table.insert("source", "lens");
  }
  return table;
}

toml::table projector_of(const ProjectorSetup& projector) {
  toml::table table{{"name", projector.name},
                    {"position_m", list_of(projector.position_m)},
                    {"yaw_deg", projector.orientation.yaw_deg},
                    {"pitch_deg", projector.orientation.pitch_deg},
                    {"roll_deg", projector.orientation.roll_deg},
                    {"resolution_px", toml::array{projector.width_px, projector.height_px}},
                    {"gamma", projector.gamma},
                    {"gain", list_of(projector.gain)},
                    {"black_level_lift", list_of(projector.black_level_lift)}};
  insert_lens(table, projector.lens);
  if (projector.mirror) {
    table.insert("mirror", toml::table{{"position_m", list_of(projector.mirror->position_m)},
                                       {"radius_m", projector.mirror->radius_m}});
  }
  if (projector.output.monitor) {
    table.insert("monitor", *projector.output.monitor);
  } else {
    table.insert("window_px", toml::array{projector.output.window_x_px, projector.output.window_y_px});
  }
  if (projector.warp) {
    table.insert("warp", warp_of(*projector.warp));
  }
  if (!projector.blend_mask.empty()) {
    table.insert("blend_mask", projector.blend_mask);
    table.insert("blend_mask_gamma", projector.blend_mask_gamma);
  }
  if (!projector.black_level_mask.empty()) {
    table.insert("black_level_mask", projector.black_level_mask);
  }
  return table;
}

}  // namespace

std::string to_toml(const DomeSetup& setup) {
  toml::array projectors;
  for (const ProjectorSetup& projector : setup.projectors) {
    projectors.push_back(projector_of(projector));
  }
  toml::table dome{{"radius_m", setup.radius_m}, {"rotation_deg", setup.rotation_deg}};
  if (setup.tilt_known || setup.tilt_deg != 0.0) {
    dome.insert("tilt_deg", setup.tilt_deg);
  }
  const toml::table root{{"dome", std::move(dome)},
                         {"viewer", toml::table{{"position_m", list_of(setup.viewer_m)}}},
                         {"projector", std::move(projectors)}};
  std::ostringstream text;
  text << root << '\n';
  return text.str();
}

void write_dome_setup(const std::filesystem::path& path, const DomeSetup& setup) {
  keep_older(path);
  write_text_atomically(path, to_toml(setup));
}

}  // namespace ergodome
