#include "content/show/view_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "content/files/toml_table.h"
#include "content/show/own_number.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

//! Maximum distance of the viewer from the dome's center [radii]: at the dome's surface, one pixel
//! would fill half the sky.
constexpr double farthest_viewer = 0.95;

//! Reads a list of at least one number; returns how many. Throws Error if it is empty or too long.
std::size_t read_numbers(TomlTable& table, std::string_view key, const toml::node& node, std::span<double> numbers,
                         const std::string& remedy) {
  const toml::array* list = node.as_array();
  if (list == nullptr || list->empty() || list->size() > numbers.size()) {
    throw table.error_at(key, fmt::format("is not a list of at most {} numbers", numbers.size()), remedy);
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    const auto number = list->get(i)->value<double>();
    if (!number || !std::isfinite(*number) || std::abs(*number) > 1e6) {
      throw table.error_at(key, "contains an entry that is not a number from -1e6 to 1e6", remedy);
    }
    numbers[i] = *number;
  }
  return list->size();
}

void read_polynomial(TomlTable& reader, ViewSettings& view) {
  const toml::node* node = reader.node("polynomial");
  if ((node != nullptr) != (view.lens == LensLaw::polynomial)) {
    throw reader.error_at(node != nullptr ? "polynomial" : "lens",
                          node != nullptr ? "is used only with lens = \"polynomial\""
                                          : "is \"polynomial\", but the polynomial is missing",
                          "write both lens = \"polynomial\" and polynomial = [f1, f3, f5, f7]");
  }
  if (node != nullptr) {
    read_numbers(reader, "polynomial", *node, view.polynomial,
                 "write [f1, f3, f5, f7] of r = f1 t + f3 t^3 + ... (r in half widths, t in radians)");
  }
}

//! Throws Error unless the lens law covers the whole field of view.
void check_lens(const TomlTable& reader, const ViewSettings& view) {
  const auto& f = view.polynomial;
  const double largest_deg = 2.0 * radian_deg * largest_half_angle(view.lens, {f[0], f[1], f[2], f[3]});
  if (view.lens == LensLaw::polynomial && view.field_of_view_deg > largest_deg) {
    throw reader.error_at(
        "polynomial",
        fmt::format("does not increase up to the edge of the field of view of {} deg", view.field_of_view_deg),
        largest_deg > 0.0 ? fmt::format("choose fov_deg up to {:.6g}, or measure the lens again", largest_deg)
                          : "choose a first number above 0, the slope at the zenith");
  }
  if (view.field_of_view_deg > largest_deg) {
    throw reader.error_at("fov_deg", fmt::format("is {}, more than this lens can show", view.field_of_view_deg),
                          fmt::format("choose at most {:.6g}", largest_deg));
  }
}

void read_dome(TomlTable& reader, const std::string& file, ViewSettings& view) {
  view.lens = static_cast<LensLaw>(
      reader.choice("lens", 0, {"equidistant", "equisolid", "stereographic", "orthographic", "polynomial"}));
  read_polynomial(reader, view);
  check_lens(reader, view);
  if (const toml::table* truncate = reader.table("truncate")) {
    TomlTable parts(*truncate, file, "view.truncate");
    view.truncation = {parts.number("bottom", 0.0, 0.0, 1.0), parts.number("top", 0.0, 0.0, 1.0)};
    parts.refuse_unknown_keys();
    if (view.truncation.bottom + view.truncation.top >= 1.0) {
      throw reader.error_at("truncate", "removes the whole picture",
                            "choose bottom and top that add up to less than 1");
    }
  }
  if (const toml::node* node = reader.node("viewer")) {
    constexpr const char* remedy = "write three numbers: [right, up, back], in radii of the dome";
    double place[3] = {};
    if (read_numbers(reader, "viewer", *node, place, remedy) != 3) {
      throw reader.error_at("viewer", "is not a position of three numbers", remedy);
    }
    view.viewer = {place[0], place[1], place[2]};
    if (!(dot(view.viewer, view.viewer) <= farthest_viewer * farthest_viewer)) {
      throw reader.error_at("viewer", "is not inside the dome",
                            fmt::format("choose a position at most {} dome radii from the center", farthest_viewer));
    }
  }
}

FrustumAngles read_frustum(const toml::table& table, const std::string& file) {
  TomlTable reader(table, file, "view.frustum");
  constexpr double most = 89.5;
  FrustumAngles angles;
  angles.left_deg = reader.number("left_deg", angles.left_deg, -most, most);
  angles.right_deg = reader.number("right_deg", angles.right_deg, -most, most);
  angles.up_deg = reader.number("up_deg", angles.up_deg, -most, most);
  angles.down_deg = reader.number("down_deg", angles.down_deg, -most, most);
  if (!(angles.right_deg - angles.left_deg >= 1e-6)) {
    throw reader.error_at("right_deg", "is not to the right of left_deg",
                          "choose a larger angle; angles to the left are negative");
  }
  if (!(angles.up_deg - angles.down_deg >= 1e-6)) {
    throw reader.error_at("up_deg", "is not above down_deg", "choose a larger angle; angles downward are negative");
  }
  reader.refuse_unknown_keys();
  return angles;
}

//! Throws Error if the field of view is set in a view that always shows the whole sky.
void check_whole_sky(const TomlTable& reader, const ViewSettings& view) {
  if (view.field_of_view_deg != usual_field_of_view_deg(view.projection)) {
    throw reader.error_at("fov_deg",
                          fmt::format("is {}, but this projection always shows the whole sky", view.field_of_view_deg),
                          "remove it, or choose the projection dome, cylinder or pinhole");
  }
}

}  // namespace

void read_view(const toml::table& table, const std::string& file, ViewSettings& view) {
  TomlTable reader(table, file, "view");
  view.projection =
      static_cast<ViewProjection>(reader.choice("projection", 0, {"dome", "equirect", "cube", "cylinder", "pinhole"}));
  const bool flat = view.projection == ViewProjection::pinhole;
  const NumberLimits fields = limits_of("view.fov_deg");
  view.field_of_view_deg = reader.number("fov_deg", usual_field_of_view_deg(view.projection), fields.least,
                                         flat ? widest_pinhole_deg : fields.greatest);
  view.tilt_deg = own_number(reader, "tilt_deg", 0.0);
  view.artistic_tilt = reader.boolean("artistic_tilt", false);
  view.size_px = reader.integer("size_px", view.size_px, 1, 16384);
  view.aspect = reader.number("aspect", 1.0, 0.01, 100.0);
  view.from_outside = reader.boolean("from_outside", false);
  view.vignette = own_number(reader, "vignette", 0.0);
  switch (view.projection) {
    case ViewProjection::dome:
      read_dome(reader, file, view);
      break;
    case ViewProjection::cube:
      check_whole_sky(reader, view);
      view.cube_files = static_cast<CubeFiles>(reader.choice("cube_layout", 0, {"cross", "strip", "faces"}));
      break;
    case ViewProjection::cylinder:
      view.height_deg = reader.number("height_deg", view.height_deg, 1e-6, 179.0);
      break;
    case ViewProjection::pinhole:
      if (const toml::table* frustum = reader.table("frustum")) {
        view.frustum = read_frustum(*frustum, file);
      }
      break;
    case ViewProjection::equirect:
      check_whole_sky(reader, view);
      break;
  }
  reader.refuse_unknown_keys();
}

}  // namespace ergodome
