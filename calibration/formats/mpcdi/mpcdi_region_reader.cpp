#include "calibration/formats/mpcdi/mpcdi_region_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "calibration/formats/mpcdi/mpcdi.h"
#include "calibration/warps/warp_mesh.h"

namespace ergodome {

namespace {

//! Rounding tolerance for the edge of a region and for the right angles of a frame.
constexpr double slack = 1e-3;

std::string shown_type(const std::string& text) { return text.substr(0, 60); }

void read_extent(const XmlElement& element, MpcdiRegion& region) {
  region.x = element.number_attribute("x");
  region.y = element.number_attribute("y");
  region.width = element.number_attribute("xSize");
  region.height = element.number_attribute("ySize");
  const bool inside = region.x >= -slack && region.y >= -slack && region.x + region.width <= 1.0 + slack &&
                      region.y + region.height <= 1.0 + slack;
  if (!inside || !(region.width > 0.0 && region.height > 0.0)) {
    throw element.error("is not within its buffer", "give x, y, xSize and ySize as fractions from 0 to 1");
  }
}

MpcdiFrame read_frame(const XmlElement& element) {
  MpcdiFrame frame;
  for (const MpcdiFrameNumber& number : mpcdi_frame_numbers) {
    frame.*number.vector.*number.component = element.number_of(number.tag);
  }
  const Vector3<double>* axes[] = {&frame.yaw_axis, &frame.pitch_axis, &frame.roll_axis};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      if (!(std::abs(dot(*axes[i], *axes[j]) - (i == j ? 1.0 : 0.0)) <= slack)) {
        throw element.error("has axes that are not orthonormal",
                            "write three unit vectors at right angles to each other");
      }
    }
  }
  return frame;
}

//! Returns the gamma of <decode> or <encode>, if it exists.
std::optional<double> read_gamma(const XmlElement& color, std::string_view name, std::vector<std::string>& left_out) {
  const auto element = color.child(name);
  const std::string type = element ? element->attribute("type").value_or("none") : "none";
  if (type == "none") {
    return std::nullopt;
  }
  if (type != "gamma") {
    left_out.emplace_back(
        element->error(fmt::format("has the unsupported type {}, which is ignored", shown_type(type)), "").what());
    return std::nullopt;
  }
  const double gamma = element->attribute("gamma") ? element->number_attribute("gamma") : element->number_of("gamma");
  if (!(gamma >= 0.1 && gamma <= 10.0)) {
    throw element->error(fmt::format("has a gamma of {}", gamma), "write a gamma from 0.1 to 10");
  }
  return gamma;
}

void read_color(const XmlElement& color, MpcdiRegion& region, std::vector<std::string>& left_out) {
  region.decode_gamma = read_gamma(color, "decode", left_out);
  region.encode_gamma = read_gamma(color, "encode", left_out);
  const auto correct = color.child("correct");
  const std::string type = correct ? correct->attribute("type").value_or("none") : "none";
  if (type != "none") {
    left_out.emplace_back(
        correct->error(fmt::format("has the unsupported type {}, which is ignored", shown_type(type)), "").what());
  }
}

void check_frustum(const Frustum& frustum, const XmlElement& region) {
  const double angles[] = {frustum.left_deg, frustum.right_deg, frustum.up_deg, frustum.down_deg};
  const bool flat = std::all_of(std::begin(angles), std::end(angles), [](double a) { return std::abs(a) < 90.0; });
  if (!flat || !(frustum.left_deg < frustum.right_deg) || !(frustum.down_deg < frustum.up_deg)) {
    throw region.error("has an impossible frustum",
                       "choose angles with leftAngle < rightAngle and downAngle < upAngle, all between -90 and 90");
  }
}

}  // namespace

MpcdiRegion read_mpcdi_region(const XmlElement& element, std::vector<std::string>& left_out) {
  MpcdiRegion region;
  region.id = element.needed_attribute("id");
  read_extent(element, region);
  region.resolution_x = element.whole_attribute("xResolution", 1, max_mesh_side);
  region.resolution_y = element.whole_attribute("yResolution", 1, max_mesh_side);
  if (const auto frustum = element.child("frustum")) {
    region.orientation = {frustum->number_of("yaw"), frustum->number_of("pitch"), frustum->number_of("roll")};
    region.frustum = {frustum->number_of("leftAngle"), frustum->number_of("rightAngle"), frustum->number_of("upAngle"),
                      frustum->number_of("downAngle")};
  }
  if (const auto frame = element.child("coordinateFrame")) {
    region.frame = read_frame(*frame);
  }
  if (const auto color = element.child("color")) {
    read_color(*color, region, left_out);
  }
  return region;
}

std::optional<MpcdiFisheye> read_mpcdi_lens(const XmlElement& element) {
  const auto fisheye = element.child("fisheye");
  if (!fisheye) {
    return std::nullopt;
  }
  MpcdiFisheye lens;
  lens.horizontal_offset = fisheye->number_of("horizontalOffset", 0.0);
  lens.vertical_offset = fisheye->number_of("verticalOffset", 0.0);
  constexpr std::string_view names[] = {"f1", "f3", "f5", "f7"};
  for (std::size_t i = 0; i < 4; ++i) {
    lens.coefficients[i] = fisheye->number_of(names[i], 0.0);
  }
  if (const auto anamorphic = element.child("anamorphic")) {
    lens.anamorphic_ratio = anamorphic->number_of("ratio", 1.0);
    lens.anamorphic_angle_deg = anamorphic->number_of("angle", 0.0);
  }
  if (!(lens.coefficients[0] > 0.0) || !(lens.anamorphic_ratio > 0.0)) {
    throw element.error("has a lens whose f1 or anamorphic ratio is not above 0", "write values above 0");
  }
  return lens;
}

void check_mpcdi_region(const MpcdiRegion& region, MpcdiProfile profile, const XmlElement& element) {
  if (is_posed(profile) && !region.frustum) {
    throw element.error("has no <frustum>", "profiles 3d and sl need one: export it again");
  }
  if (profile == MpcdiProfile::shader_lamps && !region.frame) {
    throw element.error("has no <coordinateFrame>", "profile sl needs one: export it again");
  }
  // With a fisheye lens, the angles of the frustum are near 90° on all sides and have no meaning.
  if (region.frustum && !region.fisheye) {
    check_frustum(*region.frustum, element);
  }
}

}  // namespace ergodome
