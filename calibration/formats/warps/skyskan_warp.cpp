#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "calibration/formats/warps/foreign_warp.h"
#include "calibration/formats/warps/triangle_warp.h"
#include "calibration/formats/warps/warp_text.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

class SkyskanParser {
 public:
  SkyskanParser(std::string_view text, const std::string& file) : text_(text, file), file_(file), bytes_(text.size()) {}

  ForeignWarp parse() {
    while (const auto line = text_.next()) {
      if (line->find('=') != std::string_view::npos) {
        read_key(*line);
      } else if (mesh_.columns == 0) {
        read_size(*line);
      } else {
        read_node(*line);
      }
    }
    if (mesh_.columns == 0 || mesh_.nodes.size() < wanted()) {
      throw text_.error(mesh_.columns == 0
                            ? std::string("the file ends before the mesh size")
                            : fmt::format("the file ends after {} of {} nodes", mesh_.nodes.size(), wanted()),
                        "the file is truncated or damaged; export it again");
    }
    const WarpView view = view_of_keys();
    apply_tweaks();
    return {in_reading_order(std::move(mesh_)), view, {}};
  }

 private:
  [[nodiscard]] std::size_t wanted() const {
    return static_cast<std::size_t>(mesh_.columns) * static_cast<std::size_t>(mesh_.rows);
  }

  void read_key(std::string_view line) {
    const std::size_t equals = line.find('=');
    std::string key(line.substr(0, equals));
    std::ranges::transform(key, key.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    key.erase(key.find_last_not_of(" \t") + 1);
    key.erase(0, key.find_first_not_of(" \t"));
    const auto at = values_.find(key);
    if (at == values_.end()) {
      throw text_.error(
          fmt::format("has the unknown key \"{}\"", shown_of(key)),
          "use Dome Azimuth, Dome Elevation, Horizontal FOV, Vertical FOV, Horizontal Tweak, Vertical Tweak, U Tweak "
          "or V Tweak");
    }
    std::string_view rest = line.substr(equals + 1);
    at->second = text_.number(take_word(rest), at->first);
  }

  void read_size(std::string_view line) {
    const bool has_keys = std::ranges::any_of(values_, [](const auto& key) { return key.second.has_value(); });
    std::string_view rest = line;
    if (!has_keys && !whole_number_of(take_word(rest))) {
      throw Error(file_, fmt::format("is not a Sky-Skan warp, because it begins with \"{}\"", shown_of(line)),
                  "name a file that begins with lines such as Dome Azimuth=0");
    }
    rest = line;
    const long long columns = text_.whole(take_word(rest), "the number of columns", 0, 1'000'000);
    const long long rows = text_.whole(take_word(rest), "the number of rows", 0, 1'000'000);
    if (!take_word(rest).empty()) {
      throw text_.error("is not a mesh size", "write the number of columns and the number of rows");
    }
    check_mesh_size(columns, rows, text_.location());
    constexpr std::size_t min_line = 8;  // "0 0 0 0" and the line end
    if (static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) > bytes_ / min_line + 1) {
      throw text_.error(fmt::format("declares {} x {} nodes, but is too short for them", columns, rows),
                        "the file is truncated or damaged; export it again");
    }
    mesh_.columns = static_cast<int>(columns);
    mesh_.rows = static_cast<int>(rows);
    mesh_.nodes.reserve(wanted());
  }

  void read_node(std::string_view line) {
    if (mesh_.nodes.size() == wanted()) {
      throw text_.error(fmt::format("extra line after the last of {} nodes", wanted()), "correct the mesh size");
    }
    std::string_view rest = line;
    WarpNode node;
    node.x = static_cast<float>(text_.number(take_word(rest), "x"));
    node.y = static_cast<float>(text_.number(take_word(rest), "y"));
    node.u = static_cast<float>(text_.number(take_word(rest), "u"));
    node.v = static_cast<float>(text_.number(take_word(rest), "v"));
    if (!take_word(rest).empty()) {
      throw text_.error("has more than four numbers", "write x y u v on the line");
    }
    node.valid = node.x != -1.0F && node.y != -1.0F;
    mesh_.nodes.push_back(node);
  }

  [[nodiscard]] double needed(const char* key) const {
    const auto& value = values_.at(key);
    if (!value) {
      throw Error(file_, fmt::format("has no {}", key), "write the direction and width of the view");
    }
    return *value;
  }

  [[nodiscard]] WarpView view_of_keys() const {
    const double azimuth_deg = needed("dome azimuth");
    const double elevation_deg = needed("dome elevation");
    double across_deg = needed("horizontal fov");
    if (!(across_deg > 0.0 && across_deg < 180.0)) {
      throw Error(file_, fmt::format("has a horizontal FOV of {:g}°", across_deg), "write an angle between 0 and 180");
    }
    double high_deg = values_.at("vertical fov").value_or(0.0);
    if (!(high_deg > 0.0)) {
      // The file gives no vertical field of view: computes it for a raster of 2048 x 1200.
      high_deg = 2.0 * radian_deg * std::atan(1200.0 / 2048.0 * std::tan(0.5 * one_degree * across_deg));
    }
    const double across_tweak = values_.at("horizontal tweak").value_or(1.0);
    const double high_tweak = values_.at("vertical tweak").value_or(1.0);
    across_deg *= across_tweak > 0.0 ? across_tweak : 1.0;
    high_deg *= high_tweak > 0.0 ? high_tweak : 1.0;
    const WarpView view = {{azimuth_deg, elevation_deg, 0.0},
                           {-0.5 * across_deg, 0.5 * across_deg, 0.5 * high_deg, -0.5 * high_deg}};
    check_view(view.frustum, file_);
    return view;
  }

  void apply_tweaks() {
    // Returns a factor of the texture coordinates; 1 if it is missing, or if it is -1 or less.
    const auto tweak = [this](const char* key) {
      const double value = values_.at(key).value_or(1.0);
      return static_cast<float>(value > -1.0 ? value : 1.0);
    };
    const float across = tweak("u tweak");
    const float downwards = tweak("v tweak");
    for (WarpNode& node : mesh_.nodes) {
      node.u *= across;
      node.v *= downwards;
    }
  }

  WarpText text_;
  std::string file_;
  std::size_t bytes_;
  WarpMesh mesh_;
  std::map<std::string, std::optional<double>, std::less<>> values_ = {
      {"dome azimuth", {}},     {"dome elevation", {}}, {"horizontal fov", {}}, {"vertical fov", {}},
      {"horizontal tweak", {}}, {"vertical tweak", {}}, {"u tweak", {}},        {"v tweak", {}}};
};

}  // namespace

ForeignWarp parse_skyskan_warp(std::string_view text, const std::string& file) {
  return SkyskanParser(text, file).parse();
}

}  // namespace ergodome
