#include "calibration/dome/projector_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibration/warps/warp_mesh.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

constexpr double farthest_m = 10'000.0;

bool is_node_name(const std::string& name) {
  constexpr std::size_t longest = 64;
  return !name.empty() && name.size() <= longest && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
  });
}

class ProjectorReader {
 public:
  ProjectorReader(TomlTable& table, const std::string& file, const std::filesystem::path& folder,
                  NamedFiles named_files)
      : table_(table), file_(file), folder_(folder), named_files_(named_files) {}

  ProjectorSetup read() {
    projector_.name = table_.text("name", "");
    if (projector_.name.empty()) {
      throw table_.error_at("name", "is missing", "name the projector; messages use this name");
    }
    projector_.node = table_.text("node", "");
    if (table_.has("node") && !is_node_name(projector_.node)) {
      throw table_.error_at("node", "is not the name of a computer",
                            "use 1 to 64 letters, digits, points and hyphens, as in host names");
    }
    projector_.position_m = read_position(table_, "position_m");
    projector_.orientation = {table_.number("yaw_deg", 0.0, -360.0, 360.0),
                              table_.number("pitch_deg", 0.0, -180.0, 180.0),
                              table_.number("roll_deg", 0.0, -360.0, 360.0)};
    read_lens();
    read_mirror();
    read_output();
    read_warp();
    read_colour();
    if (std::holds_alternative<std::monostate>(projector_.lens) && !projector_.warp) {
      throw table_.error_at("name", fmt::format("\"{}\" has neither a lens nor a warp", projector_.name),
                            "write frustum, fisheye or warp, which give the direction of its light");
    }
    table_.refuse_unknown_keys();
    return std::move(projector_);
  }

 private:
  void read_lens() {
    const toml::table* const frustum = table_.table("frustum");
    const toml::table* const fisheye = table_.table("fisheye");
    if (frustum != nullptr && fisheye != nullptr) {
      throw table_.error_at("fisheye", "cannot be combined with frustum",
                            "remove one of them: a projector has one lens");
    }
    if (frustum != nullptr) {
      TomlTable angles(*frustum, file_, table_.path_of("frustum"));
      projector_.lens = read_frustum(angles);
    } else if (fisheye != nullptr) {
      TomlTable lens(*fisheye, file_, table_.path_of("fisheye"));
      projector_.lens = read_fisheye(lens);
    }
  }

  static Frustum read_frustum(TomlTable& table) {
    constexpr double widest = 89.9;
    Frustum frustum;
    const auto angle = [&](std::string_view key) {
      if (!table.has(key)) {
        throw table.error_at(key, "is missing", "write left_deg, right_deg, up_deg and down_deg");
      }
      return table.number(key, 0.0, -widest, widest);
    };
    frustum.left_deg = angle("left_deg");
    frustum.right_deg = angle("right_deg");
    frustum.up_deg = angle("up_deg");
    frustum.down_deg = angle("down_deg");
    if (!(frustum.left_deg < frustum.right_deg)) {
      throw table.error_at("left_deg", "is not below right_deg", "write angles to the left as negative numbers");
    }
    if (!(frustum.down_deg < frustum.up_deg)) {
      throw table.error_at("down_deg", "is not below up_deg", "write angles downward as negative numbers");
    }
    table.refuse_unknown_keys();
    return frustum;
  }

  static ProjectorFisheye read_fisheye(TomlTable& table) {
    ProjectorFisheye lens;
    lens.field_of_view_deg = table.number("fov_deg", lens.field_of_view_deg, 1.0, 360.0);
    lens.circle = table.number("circle", lens.circle, 0.01, 100.0);
    lens.polynomial = table.numbers("polynomial", 1, 4, -1e6, 1e6);
    const auto offset = table.numbers("offset", 2, 2, -10.0, 10.0);
    if (!offset.empty()) {
      lens.offset_x = offset[0];
      lens.offset_y = offset[1];
    }
    if (!lens.polynomial.empty() && table.has("circle")) {
      throw table.error_at("circle", "cannot be combined with polynomial",
                           "remove circle: the polynomial determines the size");
    }
    constexpr double rounding = 0.002;
    if (!lens.polynomial.empty() &&
        growing_angle(lens.polynomial) < 0.5 * one_degree * lens.field_of_view_deg - rounding) {
      throw table.error_at("polynomial", "does not increase up to the edge of the field of view",
                           "choose f1, f3, f5, f7 so that r = f1 t + f3 t^3 + f5 t^5 + f7 t^7, with t in radians, "
                           "increases for t from 0 to half of fov_deg");
    }
    table.refuse_unknown_keys();
    return lens;
  }

  void read_mirror() {
    const toml::table* const node = table_.table("mirror");
    if (node == nullptr) {
      return;
    }
    TomlTable mirror(*node, file_, table_.path_of("mirror"));
    if (!mirror.has("position_m") || !mirror.has("radius_m")) {
      throw mirror.error_at("position_m", "or radius_m is missing", "write both, in meters");
    }
    projector_.mirror =
        SphericalMirror{read_position(mirror, "position_m"), mirror.number("radius_m", 0.3, 0.001, 100.0)};
    mirror.refuse_unknown_keys();
    const Vector3<double> apart = projector_.mirror->position_m - projector_.position_m;
    if (!(std::sqrt(dot(apart, apart)) > projector_.mirror->radius_m)) {
      throw mirror.error_at("radius_m", "is so large that the projector is inside the mirror",
                            "correct it, or position_m of the mirror or the projector");
    }
    if (std::holds_alternative<std::monostate>(projector_.lens)) {
      throw mirror.error_at("radius_m", "needs a projector with a lens", "write its frustum or fisheye");
    }
  }

  void read_output() {
    const auto size = table_.numbers("resolution_px", 2, 2, 2.0, max_mesh_side);
    if (size.empty()) {
      throw table_.error_at("resolution_px", "is missing", "write resolution_px = [width, height]");
    }
    projector_.width_px = whole(size[0], "resolution_px");
    projector_.height_px = whole(size[1], "resolution_px");
    constexpr double widest_desktop = 1e6;
    const auto window = table_.numbers("window_px", 2, 2, -widest_desktop, widest_desktop);
    if (table_.has("monitor")) {
      projector_.output.monitor = table_.integer("monitor", 0, 0, 63);
    }
    if (projector_.output.monitor && !window.empty()) {
      throw table_.error_at("window_px", "cannot be combined with monitor",
                            "remove one of them: a projector has one output");
    }
    if (!window.empty()) {
      projector_.output.window_x_px = whole(window[0], "window_px");
      projector_.output.window_y_px = whole(window[1], "window_px");
    }
  }

  int whole(double value, std::string_view key) const {
    if (value != std::floor(value)) {
      throw table_.error_at(key, "contains a fraction of a pixel", "write whole numbers");
    }
    return static_cast<int>(value);
  }

  //! Returns a file that the setup names under `key`; empty if it does not name one. Throws Error
  //! for an empty name or a missing file.
  std::string read_file(TomlTable& table, std::string_view key) const {
    std::string name = table.text(key, "");
    if (table.has(key) && name.empty()) {
      throw table.error_at(key, "is empty", "name a file, or remove the line");
    }
    std::error_code problem;
    if (!name.empty() && named_files_ == NamedFiles::must_exist &&
        !std::filesystem::is_regular_file(folder_ / name, problem)) {
      throw table.error_at(key,
                           fmt::format("names {}, which does not exist or is not a file", (folder_ / name).string()),
                           "correct the path; it is relative to the setup's folder");
    }
    return name;
  }

  void read_warp() {
    const toml::node* const node = table_.node("warp");
    if (node == nullptr) {
      return;
    }
    if (!node->is_table()) {
      WarpFile warp;
      warp.file = read_file(table_, "warp");
      warp.format = format_of(table_, "warp", warp.file);
      projector_.warp = warp;
      return;
    }
    TomlTable table(*node->as_table(), file_, table_.path_of("warp"));
    projector_.warp = read_warp_table(table);
  }

  WarpFile read_warp_table(TomlTable& table) const {
    WarpFile warp;
    warp.file = read_file(table, "file");
    if (warp.file.empty()) {
      throw table.error_at("file", "is missing", "name the warp file");
    }
    warp.format = table.has("format")
                      ? static_cast<WarpFormat>(table.choice("format", 0,
                                                             {"bourke", "pfm", "mpcdi", "domeprojection", "obj",
                                                              "sciss", "easyblend", "simcad", "skyskan"}))
                      : format_of(table, "file", warp.file);
    const auto only_for = [&](std::string_view key, bool suits, const char* formats) {
      if (table.has(key) && !suits) {
        throw table.error_at(key, "has no meaning in this format",
                             fmt::format("remove it; it is only for {}", formats));
      }
    };
    only_for("rows", warp.format == WarpFormat::pfm || warp.format == WarpFormat::mpcdi, "pfm and mpcdi");
    only_for("texture", warp.format == WarpFormat::pfm, "pfm");
    only_for("region", warp.format == WarpFormat::mpcdi, "mpcdi");
    only_for("x_range", warp.format == WarpFormat::bourke, "bourke");
    only_for("source", has_no_source_size(warp.format),
             "bourke, pfm, domeprojection, obj, simcad and easyblend, whose files do not name the source");
    warp.rows = static_cast<RowOrder>(table.choice("rows", 0, {"bottom_up", "top_down"}));
    warp.texture = static_cast<TextureDirection>(table.choice("texture", 0, {"downwards", "upwards"}));
    warp.region = table.text("region", "");
    warp.x_to_one = table.choice("x_range", 0, {"aspect", "one"}) == 1;
    warp.source = static_cast<WarpSource>(table.choice("source", 0, {"domemaster", "lens"}));
    if (warp.source == WarpSource::lens_picture && !std::holds_alternative<Frustum>(projector_.lens)) {
      throw table.error_at(
          "source", "is \"lens\", but the projector has no frustum",
          "write the frustum of the image that the warp samples, with yaw_deg, pitch_deg and roll_deg");
    }
    table.refuse_unknown_keys();
    return warp;
  }

  //! Returns the format of a warp from its content, or else from its extension. For files that need
  //! not exist, only the extension counts.
  WarpFormat format_of(const TomlTable& table, std::string_view key, const std::string& name) const {
    const std::string ending = std::filesystem::path(name).extension().string();
    const auto format =
        named_files_ == NamedFiles::must_exist ? warp_format_of(folder_ / name) : format_of_ending(ending);
    if (format) {
      return *format;
    }
    throw table.error_at(
        key, fmt::format("names a file of an unknown format (ending \"{}\")", ending.substr(0, 20)),
        "write { file = \"...\", format = \"bourke\" }, or the format pfm, mpcdi, domeprojection, obj, "
        "sciss, easyblend, simcad or skyskan");
  }

  void read_colour() {
    projector_.blend_mask = read_file(table_, "blend_mask");
    projector_.blend_mask_gamma = table_.number("blend_mask_gamma", 1.0, 0.1, 10.0);
    if (table_.has("blend_mask_gamma") && projector_.blend_mask.empty()) {
      throw table_.error_at("blend_mask_gamma", "is set without blend_mask", "name the mask, or remove this key");
    }
    projector_.black_level_mask = read_file(table_, "black_level_mask");
    projector_.black_level_lift = read_colour_of("black_level_lift", projector_.black_level_lift, 0.5);
    projector_.gamma = table_.number("gamma", projector_.gamma, 0.1, 10.0);
    projector_.gain = read_colour_of("gain", projector_.gain, 10.0);
    const bool lifts =
        projector_.black_level_lift.x + projector_.black_level_lift.y + projector_.black_level_lift.z > 0.0;
    if (!projector_.black_level_mask.empty() && !lifts) {
      throw table_.error_at("black_level_mask", "is set without black_level_lift",
                            "write the lift, such as black_level_lift = 0.01");
    }
  }

  //! Reads one number for all colors, or three.
  Vector3<double> read_colour_of(std::string_view key, const Vector3<double>& otherwise, double maximum) {
    const toml::node* const node = table_.node(key);
    if (node == nullptr) {
      return otherwise;
    }
    if (!node->is_array()) {
      const double grey = table_.number(key, 0.0, 0.0, maximum);
      return {grey, grey, grey};
    }
    const auto colour = table_.numbers(key, 3, 3, 0.0, maximum);
    return {colour[0], colour[1], colour[2]};
  }

  TomlTable& table_;
  const std::string& file_;
  const std::filesystem::path& folder_;
  NamedFiles named_files_;
  ProjectorSetup projector_;
};

}  // namespace

Vector3<double> read_position(TomlTable& table, std::string_view key) {
  const auto position = table.numbers(key, 3, 3, -farthest_m, farthest_m);
  return position.empty() ? Vector3<double>{0.0, 0.0, 0.0} : Vector3<double>{position[0], position[1], position[2]};
}

ProjectorSetup read_projector(TomlTable& table, const std::string& file, const std::filesystem::path& folder,
                              NamedFiles named_files) {
  return ProjectorReader(table, file, folder, named_files).read();
}

}  // namespace ergodome
