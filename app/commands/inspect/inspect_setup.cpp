#include "app/commands/inspect/inspect_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/projectors/projector_optics.h"
#include "calibration/projectors/projector_picture.h"
#include "content/files/console.h"
#include "content/files/toml_table.h"
#include "content/files/whole_file.h"
#include "render/output/image_writer.h"
#include "render/patterns/setup_picture.h"

namespace ergodome {

namespace {

const char* lens_word(const Lens& lens) {
  constexpr const char* words[] = {"none", "frustum", "fisheye"};
  return words[lens.index()];
}

nlohmann::json summary_of(const ProjectorSetup& projector, const ProjectorPicture& picture, double lit_part) {
  nlohmann::json summary = {{"name", projector.name},
                            {"width_px", projector.width_px},
                            {"height_px", projector.height_px},
                            {"lens", lens_word(projector.lens)},
                            {"warp", projector.warp ? projector.warp->file : "from geometry"},
                            {"columns", picture.warp.columns},
                            {"rows", picture.warp.rows},
                            {"blend_mask", picture.blend.width > 0},
                            {"gamma", projector.gamma},
                            {"lit_part", lit_part}};
  if (projector.output.monitor) {
    summary["monitor"] = *projector.output.monitor;
  } else {
    summary["window_px"] = {projector.output.window_x_px, projector.output.window_y_px};
  }
  return summary;
}

//! Returns a note if a rectangular Bourke mesh is as high as its raster but, on both sides alike,
//! narrower or wider: it was probably made for another aspect ratio. Otherwise returns an empty
//! text.
std::string note_of_shape(const ProjectorSetup& projector, const WarpMesh& mesh) {
  constexpr float tolerance = 0.01F;
  if (!projector.warp || projector.warp->format != WarpFormat::bourke || mesh.topology == MeshTopology::polar) {
    return {};
  }
  const auto [left, right] = std::ranges::minmax(mesh.nodes, {}, &WarpNode::x);
  const auto [top, bottom] = std::ranges::minmax(mesh.nodes, {}, &WarpNode::y);
  const bool fills_height = std::abs(top.y) < tolerance && std::abs(1.0F - bottom.y) < tolerance;
  const bool fills_width = std::abs(left.x) < tolerance && std::abs(1.0F - right.x) < tolerance;
  const bool even = std::abs(left.x + right.x - 1.0F) < tolerance;
  if (!fills_height || fills_width || !even) {
    return {};
  }
  const double read_to = projector.warp->x_to_one ? 1.0 : static_cast<double>(projector.width_px) / projector.height_px;
  const double half_width = read_to * (static_cast<double>(right.x) - static_cast<double>(left.x));
  const bool to_one = std::abs(half_width - 1.0) < static_cast<double>(tolerance);
  return fmt::format(
      "{}: x in {} extends to {:.3f}, but the raster's edges are at {:.3f}, so {}; {}", projector.name,
      projector.warp->file, half_width, read_to,
      half_width < read_to ? "the edges stay black" : "the mesh extends beyond them",
      to_one ? "set x_range = \"one\" to fill the raster"
             : fmt::format("it may be for a raster of another aspect ratio (ergodome convert {} MESH.pfm --aspect "
                           "{:.4f} makes a map that fits any raster)",
                           projector.warp->file, half_width));
}

//! Returns whether a projector without a warp, placed by its lens and position, stands outside the
//! dome's sphere.
bool stands_outside(const DomeSetup& setup, const ProjectorSetup& projector) {
  const bool placed = !projector.warp && !std::holds_alternative<std::monostate>(projector.lens);
  return placed && ProjectorOptics(setup, projector).outside();
}

std::vector<std::string> remarks_on(const DomeSetup& setup, const std::vector<ProjectorPicture>& pictures) {
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const ProjectorSetup& projector = setup.projectors[i];
    if (stands_outside(setup, projector)) {
      notes.push_back(projector.name + outside_note);
    }
    for (const std::string& note : pictures[i].notes) {
      notes.push_back(fmt::format("{}: {}", projector.name, note));
    }
    if (std::string note = note_of_shape(projector, pictures[i].warp); !note.empty()) {
      notes.push_back(std::move(note));
    }
  }
  return notes;
}

}  // namespace

bool is_dome_setup(const std::string& file) {
  if (!file.ends_with(".toml")) {
    return false;
  }
  try {
    const toml::table table = parse_toml(read_whole_file(file, std::size_t{4} << 20U, ""), file, 4, "dome setup");
    return table.contains("projector") || table.contains("dome");
  } catch (const std::exception&) {
    // A malformed file is handled as a show, so that the show reader reports what is wrong.
    return false;
  }
}

nlohmann::json inspect_setup(const std::string& file, const std::string& picture, int size_px) {
  const DomeSetup setup = read_dome_setup(file);
  const std::vector<ProjectorPicture> pictures = projector_pictures(setup);
  const std::vector<double> lit = lit_parts(pictures);
  nlohmann::json summary = {{"radius_m", setup.radius_m},
                            {"tilt_deg", setup.tilt_deg},
                            {"rotation_deg", setup.rotation_deg},
                            {"enough_master_px", enough_master_px(pictures)},
                            {"dark_part", lit.back()}};
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    summary["projectors"].push_back(summary_of(setup.projectors[i], pictures[i], lit[i]));
  }
  summary["notes"] = remarks_on(setup, pictures);
  if (!picture.empty()) {
    write_picture(picture, {}, draw_setup(pictures, size_px), {});
  }
  return summary;
}

void print_setup(const nlohmann::json& summary) {
  for (const char* name : {"radius_m", "tilt_deg", "rotation_deg", "enough_master_px"}) {
    print_out("{:<18}{}\n", name, summary[name].dump());
  }
  print_out("\n{:>3} {:<16} {:>11} {:>8} {:>11} {:>6} {:>8}  {}\n", "", "projector", "raster", "lens", "warp", "mask",
            "dome lit", "warp from");
  int number = 0;
  for (const auto& projector : summary["projectors"]) {
    print_out("{:>3} {:<16} {:>11} {:>8} {:>11} {:>6} {:>6.1f} %  {}\n", ++number, projector["name"].get<std::string>(),
              fmt::format("{} x {}", projector["width_px"].get<int>(), projector["height_px"].get<int>()),
              projector["lens"].get<std::string>(),
              fmt::format("{} x {}", projector["columns"].get<int>(), projector["rows"].get<int>()),
              projector["blend_mask"].get<bool>() ? "yes" : "no", 100.0 * projector["lit_part"].get<double>(),
              projector["warp"].get<std::string>());
  }
  print_out("{:.1f} % of the dome is lit by no projector\n", 100.0 * summary["dark_part"].get<double>());
  for (const auto& note : summary["notes"]) {
    print_out("{}\n", note.get<std::string>());
  }
}

}  // namespace ergodome
