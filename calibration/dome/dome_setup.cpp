#include "calibration/dome/dome_setup.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "calibration/dome/projector_reader.h"
#include "content/files/atomic_file.h"
#include "content/files/toml_table.h"
#include "content/files/whole_file.h"

namespace ergodome {

namespace {

constexpr std::size_t largest_mib = 4;
constexpr std::size_t max_projectors = 64;

void read_dome(TomlTable& root, const std::string& file, DomeSetup& setup) {
  const toml::table* const node = root.table("dome");
  if (node == nullptr) {
    throw root.error_at("dome", "is missing", "write [dome] with radius_m");
  }
  TomlTable dome(*node, file, "dome");
  if (!dome.has("radius_m")) {
    throw dome.error_at("radius_m", "is missing", "write the radius of the dome's sphere in meters");
  }
  setup.radius_m = dome.number("radius_m", setup.radius_m, 0.1, 1000.0);
  setup.tilt_known = dome.has("tilt_deg");
  setup.tilt_deg = dome.number("tilt_deg", setup.tilt_deg, -90.0, 90.0);
  setup.rotation_deg = dome.number("rotation_deg", setup.rotation_deg, -360.0, 360.0);
  dome.refuse_unknown_keys();
}

void read_viewer(TomlTable& root, const std::string& file, DomeSetup& setup) {
  const toml::table* const node = root.table("viewer");
  if (node == nullptr) {
    return;
  }
  TomlTable viewer(*node, file, "viewer");
  setup.viewer_m = read_position(viewer, "position_m");
  if (!(std::sqrt(dot(setup.viewer_m, setup.viewer_m)) < setup.radius_m)) {
    throw viewer.error_at("position_m", "lies outside the dome",
                          fmt::format("keep it within {} m of the center", setup.radius_m));
  }
  viewer.refuse_unknown_keys();
}

bool share_output(const ProjectorSetup& a, const ProjectorSetup& b) {
  if (a.node != b.node) {
    return false;
  }
  if (a.output.monitor || b.output.monitor) {
    return a.output.monitor == b.output.monitor;
  }
  return a.output.window_x_px < b.output.window_x_px + b.width_px &&
         b.output.window_x_px < a.output.window_x_px + a.width_px &&
         a.output.window_y_px < b.output.window_y_px + b.height_px &&
         b.output.window_y_px < a.output.window_y_px + a.height_px;
}

//! Throws Error if two projectors share a name or a monitor, or if their windows overlap on the
//! desktop.
void check_apart(const TomlTable& table, const ProjectorSetup& projector, const ProjectorSetup& other) {
  if (projector.name == other.name) {
    throw table.error_at("name", fmt::format("\"{}\" is used twice", projector.name.substr(0, 60)),
                         "give each projector its own name");
  }
  if (share_output(projector, other)) {
    throw table.error_at(projector.output.monitor ? "monitor" : "window_px",
                         fmt::format("overlaps the output of \"{}\"", other.name.substr(0, 60)),
                         "give each projector its own monitor, or its own area of the desktop with window_px = [x, y]");
  }
}

//! Throws Error for projectors more than ten dome radii from the center and for mirrors outside the
//! dome, which indicate a wrong unit.
void check_positions(const TomlTable& table, const ProjectorSetup& projector, double radius_m) {
  constexpr double farthest_radii = 10.0;
  if (!(std::sqrt(dot(projector.position_m, projector.position_m)) <= farthest_radii * radius_m)) {
    throw table.error_at("position_m", "is more than ten dome radii away from the center", "write positions in meters");
  }
  if (projector.mirror && !(std::sqrt(dot(projector.mirror->position_m, projector.mirror->position_m)) < radius_m)) {
    throw table.error_at("mirror", "lies outside the dome", "correct its position_m, in meters from the dome's center");
  }
}

void read_cluster(TomlTable& root, const std::string& file, DomeSetup& setup) {
  const toml::table* const node = root.table("cluster");
  if (node == nullptr) {
    const auto elsewhere = std::ranges::find_if(setup.projectors, [](const auto& each) { return !each.node.empty(); });
    if (elsewhere != setup.projectors.end()) {
      throw root.error_at("cluster", fmt::format("is missing, but projector {} is at a node", elsewhere->name),
                          "write [cluster] with address and key, or remove node");
    }
    return;
  }
  TomlTable table(*node, file, "cluster");
  ClusterSetup& cluster = setup.cluster.emplace();
  cluster.sync = static_cast<SwapSync>(table.choice("sync", static_cast<int>(cluster.sync), swap_sync_names));
  cluster.address = table.text("address", cluster.address);
  if (cluster.address.empty() || cluster.address.find_first_of("*/: ") != std::string::npos) {
    throw table.error_at("address", "is neither an IPv4 address nor a network interface",
                         "write the master's address or interface, as in address = \"10.0.0.1\" or \"eth1\"");
  }
  constexpr int last_port = 65535;
  cluster.port = table.integer("port", cluster.port, 1, last_port);
  cluster.key = table.text("key", "");
  if (cluster.key.empty()) {
    throw table.error_at("key", "is missing", "make one with ergodome node --make-key dome.key, and name the file");
  }
  table.refuse_unknown_keys();
}

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
  if (!projector.node.empty()) {
    table.insert("node", projector.node);
  }
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

std::string location_of(const ProjectorSetup& projector) {
  return fmt::format("{}{}projector {}", projector.read_from, projector.read_from.empty() ? "" : ", ", projector.name);
}

DomeSetup parse_dome_setup(std::string_view text, const std::string& file, NamedFiles named_files) {
  const toml::table parsed = parse_toml(text, file, largest_mib, "a dome setup");
  DomeSetup setup;
  setup.folder = std::filesystem::path(file).parent_path();
  TomlTable root(parsed, file, "");
  read_dome(root, file, setup);
  read_viewer(root, file, setup);
  const auto tables = root.tables("projector", max_projectors);
  if (tables.empty()) {
    throw root.error_at("projector", "is missing", "write a [[projector]] for each projector of the dome");
  }
  for (std::size_t i = 0; i < tables.size(); ++i) {
    TomlTable table(*tables[i], file, fmt::format("projector[{}]", i));
    ProjectorSetup projector = read_projector(table, file, setup.folder, named_files);
    projector.read_from = fmt::format("{}:{}", file, tables[i]->source().begin.line);
    check_positions(table, projector, setup.radius_m);
    for (const ProjectorSetup& other : setup.projectors) {
      check_apart(table, projector, other);
    }
    setup.projectors.push_back(std::move(projector));
  }
  read_cluster(root, file, setup);
  root.refuse_unknown_keys();
  return setup;
}

DomeSetup read_dome_setup(const std::filesystem::path& path) {
  if (path.extension() == ".mpcdi") {
    throw Error(path.string(), "is a calibration, not a dome setup",
                fmt::format("convert it: ergodome convert {} dome.toml", path.string()));
  }
  if (path.extension() == ".data" || path.extension() == ".pfm") {
    throw Error(path.string(), "is a warp mesh, not a dome setup",
                fmt::format("write warp = \"{}\" for a projector of a dome setup", path.filename().string()));
  }
  return parse_dome_setup(read_whole_file(path, largest_mib << 20U, "give the path of a dome setup (.toml)"),
                          path.string(), NamedFiles::must_exist);
}

std::string to_toml(const DomeSetup& setup) {
  toml::array projectors;
  for (const ProjectorSetup& projector : setup.projectors) {
    projectors.push_back(projector_of(projector));
  }
  toml::table dome{{"radius_m", setup.radius_m}, {"rotation_deg", setup.rotation_deg}};
  if (setup.tilt_known || setup.tilt_deg != 0.0) {
    dome.insert("tilt_deg", setup.tilt_deg);
  }
  toml::table root{{"dome", std::move(dome)},
                   {"viewer", toml::table{{"position_m", list_of(setup.viewer_m)}}},
                   {"projector", std::move(projectors)}};
  if (setup.cluster) {
    root.insert("cluster", toml::table{{"sync", swap_sync_names[static_cast<std::size_t>(setup.cluster->sync)]},
                                       {"address", setup.cluster->address},
                                       {"port", setup.cluster->port},
                                       {"key", setup.cluster->key}});
  }
  std::ostringstream text;
  text << root << '\n';
  return text.str();
}

std::vector<std::string> node_names(const DomeSetup& setup) {
  std::vector<std::string> names;
  for (const ProjectorSetup& projector : setup.projectors) {
    if (!projector.node.empty() && std::ranges::find(names, projector.node) == names.end()) {
      names.push_back(projector.node);
    }
  }
  return names;
}

DomeSetup part_of_setup(const DomeSetup& setup, const std::string& node) {
  DomeSetup part = setup;
  std::erase_if(part.projectors, [&](const ProjectorSetup& projector) { return projector.node != node; });
  return part;
}

void write_dome_setup(const std::filesystem::path& path, const DomeSetup& setup) {
  keep_older(path);
  write_text_atomically(path, to_toml(setup));
}

}  // namespace ergodome
