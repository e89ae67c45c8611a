#include <fmt/format.h>

#include <cmath>

#include "calibration/formats/mpcdi/xml_element.h"
#include "calibration/formats/warps/foreign_warp.h"
#include "calibration/formats/warps/triangle_warp.h"
#include "calibration/formats/warps/warp_text.h"

namespace ergodome {

namespace {

constexpr std::size_t max_simcad_bytes = std::size_t{64} << 20U;

//! Returns an element's offsets as fractions of the raster.
std::vector<double> offsets_of(const XmlElement& element) {
  if (!element.attribute("range")) {
    throw element.error("has no range attribute",
                        "write range = \"1\" for offsets in fractions of the raster, or its size in pixels");
  }
  const double range = element.number_attribute("range");
  if (!(std::abs(range) > 0.0)) {
    throw element.error("has a range of 0",
                        "write range = \"1\" for offsets in fractions of the raster, or its size in pixels");
  }
  const std::string text = element.text();
  std::string_view rest = text;
  std::vector<double> offsets;
  for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
    const auto value = decimal_of(word);
    constexpr double farthest = 1e4;
    if (!value || !(std::abs(*value / range) <= farthest)) {
      throw element.error(fmt::format("has the invalid offset \"{}\"", shown_of(word)),
                          "write finite numbers separated by spaces");
    }
    offsets.push_back(*value / range);
  }
  return offsets;
}

}  // namespace

ForeignWarp parse_simcad_warp(std::string_view text, const std::string& file) {
  if (text.size() > max_simcad_bytes) {
    throw Error(file, "is a SimCAD warp of more than 64 MiB", "export it again");
  }
  const XmlFile xml(text, file);
  const XmlElement root(xml, xml.root());
  if (root.name() != "GeometryFile") {
    throw root.error("is not a SimCAD warp", "name a file whose root element is <GeometryFile>");
  }
  const XmlElement definition = root.needed_child("GeometryDefinition");
  const XmlElement across = definition.needed_child("X-FlatParameters");
  const std::vector<double> x = offsets_of(across);
  const std::vector<double> y = offsets_of(definition.needed_child("Y-FlatParameters"));
  const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(x.size()))));
  if (x.size() != y.size() || side * side != x.size()) {
    throw across.error(fmt::format("has {} offsets, and Y-FlatParameters has {}", x.size(), y.size()),
                       "export the same number of both, for a square grid such as 33 x 33");
  }
  check_mesh_size(static_cast<long long>(side), static_cast<long long>(side), file);
  WarpMesh mesh{MeshTopology::rectangular, static_cast<int>(side), static_cast<int>(side), {}};
  mesh.nodes.reserve(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t row = i / side;
    const double u = static_cast<double>(i % side) / static_cast<double>(side - 1);
    const double v = static_cast<double>(row) / static_cast<double>(side - 1);
    mesh.nodes.push_back(
        {static_cast<float>(u + x[i]), static_cast<float>(v + y[i]), static_cast<float>(u), static_cast<float>(v)});
  }
  return {in_reading_order(std::move(mesh)), std::nullopt, {}};
}

}  // namespace ergodome
