#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "content/show/show_schema.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

//! Maximum distance of the viewer from the dome's center [radii]: at the dome's surface, one pixel
//! would fill half the sky.
constexpr double farthest_viewer = 0.95;
constexpr double widest_pinhole_deg = 179.0;

constexpr const char* of_the_picture = "all frames of a show have the same size";
constexpr const char* of_the_screen = "it describes the screen, which does not change during a show";

constexpr std::array lens_names = {"equidistant", "equisolid", "stereographic", "orthographic", "polynomial"};
constexpr std::array cube_file_names = {"cross", "strip", "faces"};

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

double widest_field_deg(const ViewSettings& view) {
  const auto& f = view.polynomial;
  return 2.0 * radian_deg * largest_half_angle(view.lens, {f[0], f[1], f[2], f[3]});
}

//! Throws Error unless the lens law covers the whole field of view.
void check_lens(const TomlTable& table, const ViewSettings& view) {
  const double largest_deg = widest_field_deg(view);
  if (view.lens == LensLaw::polynomial && view.field_of_view_deg > largest_deg) {
    throw table.error_at(
        "polynomial",
        fmt::format("does not increase up to the edge of the field of view of {} deg", view.field_of_view_deg),
        largest_deg > 0.0 ? fmt::format("choose fov_deg up to {:.6g}, or measure the lens again", largest_deg)
                          : "choose a first number above 0, the slope at the zenith");
  }
  if (view.field_of_view_deg > largest_deg) {
    throw table.error_at("fov_deg", fmt::format("is {}, more than this lens can show", view.field_of_view_deg),
                         fmt::format("choose at most {:.6g}", largest_deg));
  }
}

constexpr auto read_polynomial = [](TomlTable& table, ViewSettings& view) {
  const toml::node* node = table.node("polynomial");
  if ((node != nullptr) != (view.lens == LensLaw::polynomial)) {
    throw table.error_at(node != nullptr ? "polynomial" : "lens",
                         node != nullptr ? "is used only with lens = \"polynomial\""
                                         : "is \"polynomial\", but the polynomial is missing",
                         "write both lens = \"polynomial\" and polynomial = [f1, f3, f5, f7]");
  }
  if (node != nullptr) {
    read_numbers(table, "polynomial", *node, view.polynomial,
                 "write [f1, f3, f5, f7] of r = f1 t + f3 t^3 + ... (r in half widths, t in radians)");
  }
  check_lens(table, view);
};

constexpr auto write_polynomial = [](toml::table& table, const ViewSettings& view) {
  if (view.lens == LensLaw::polynomial) {
    const auto& f = view.polynomial;
    table.insert("polynomial", toml::array{f[0], f[1], f[2], f[3]});
  }
};

constexpr auto read_viewer = [](TomlTable& table, ViewSettings& view) {
  const toml::node* const node = table.node("viewer");
  if (node == nullptr) {
    return;
  }
  constexpr const char* remedy = "write three numbers: [right, up, back], in radii of the dome";
  double position[3] = {};
  if (read_numbers(table, "viewer", *node, position, remedy) != 3) {
    throw table.error_at("viewer", "is not a position of three numbers", remedy);
  }
  view.viewer = {position[0], position[1], position[2]};
  if (!(dot(view.viewer, view.viewer) <= farthest_viewer * farthest_viewer)) {
    throw table.error_at("viewer", "is not inside the dome",
                         fmt::format("choose a position at most {} dome radii from the center", farthest_viewer));
  }
};

constexpr auto write_viewer = [](toml::table& table, const ViewSettings& view) {
  table.insert("viewer", toml::array{view.viewer.x, view.viewer.y, view.viewer.z});
};

template <ViewProjection Projection>
constexpr auto only_in = [](const ViewSettings& view) { return view.projection == Projection; };

constexpr auto usual_field = [](const TomlTable& /*table*/, ViewSettings& view) {
  view.field_of_view_deg = usual_field_of_view_deg(view.projection);
};

constexpr auto field_limits = [](const ViewSettings& view) -> NumberLimits {
  const double widest_deg = view.projection == ViewProjection::pinhole ? widest_pinhole_deg
                            : view.projection == ViewProjection::dome  ? std::min(360.0, widest_field_deg(view))
                                                                       : 360.0;
  return {1e-6, widest_deg};
};

constexpr auto check_whole_sky = [](const TomlTable& table, const ViewSettings& view) {
  if (view.projection == ViewProjection::cube && view.field_of_view_deg != usual_field_of_view_deg(view.projection)) {
    throw table.error_at("fov_deg",
                         fmt::format("is {}, but this projection always shows the whole sky", view.field_of_view_deg),
                         "remove it, or choose the projection dome, equirect, cylinder or pinhole");
  }
};

constexpr auto unused_field = [](const Show& /*show*/, const ViewSettings& view) {
  return view.frustum            ? "is replaced by view.frustum"
         : shows_whole_sky(view) ? "has no effect: this projection shows the whole sphere"
                                 : nullptr;
};

constexpr auto unused_aspect = [](const Show& /*show*/, const ViewSettings& view) {
  return view.frustum                                 ? "is replaced by view.frustum"
         : view.projection != ViewProjection::pinhole ? "is used only with projection = \"pinhole\""
                                                      : nullptr;
};

constexpr auto unused_tilt = [](const Show& /*show*/, const ViewSettings& view) {
  return view.projection != ViewProjection::dome ? "is used only with projection = \"dome\"" : nullptr;
};

constexpr auto unused_vignette = [](const Show& /*show*/, const ViewSettings& view) {
  return view.projection != ViewProjection::dome && view.projection != ViewProjection::pinhole
             ? "is used only with projection = \"dome\" or \"pinhole\""
             : nullptr;
};

constexpr auto truncation_keys = keys_of<DomeTruncation>(
    key<&DomeTruncation::bottom>(
        "bottom", "Dome: part of the picture's height at the bottom that stays black and is not rendered.")
        .range(0.0, 1.0, "height"),
    key<&DomeTruncation::top>("top", "Dome: the same at the top. Both parts together are below 1.")
        .range(0.0, 1.0, "height"));

constexpr auto frustum_keys = keys_of<FrustumAngles>(
    key<&FrustumAngles::left_deg>(
        "left_deg", "Pinhole: left side, as an angle from the axis. A frustum replaces `fov_deg` and `aspect`.")
        .range(-89.5, 89.5, "deg"),
    key<&FrustumAngles::right_deg>("right_deg", "Pinhole: right side.")
        .range(-89.5, 89.5, "deg")
        .after([](const TomlTable& table, const FrustumAngles& angles) {
          if (!(angles.right_deg - angles.left_deg >= 1e-6)) {
            throw table.error_at("right_deg", "is not to the right of left_deg",
                                 "choose a larger angle; angles to the left are negative");
          }
        })
        .page({.bounds = "-89.5 to 89.5, above `left_deg`"}),
    key<&FrustumAngles::up_deg>("up_deg", "Pinhole: upper side.").range(-89.5, 89.5, "deg"),
    key<&FrustumAngles::down_deg>("down_deg", "Pinhole: lower side.")
        .range(-89.5, 89.5, "deg")
        .after([](const TomlTable& table, const FrustumAngles& angles) {
          if (!(angles.up_deg - angles.down_deg >= 1e-6)) {
            throw table.error_at("up_deg", "is not above down_deg",
                                 "choose a larger angle; angles downward are negative");
          }
        })
        .page({.bounds = "-89.5 to 89.5, below `up_deg`"}));

constexpr auto keys_of_view = keys_of<ViewSettings>(
    key<&ViewSettings::projection>("projection", "[Projection](projections.md) of the picture.")
        .words(view_projection_names),
    key<&ViewSettings::size_px>("size_px",
                                "Width of one eye's picture. With `cube_layout = \"faces\"`: width of a face.")
        .range(1, 16384, "px")
        .fixed(of_the_picture),
    key<&ViewSettings::field_of_view_deg>("fov_deg", "Field of view.")
        .range(1e-6, 360.0, "deg")
        .range_in(field_limits)
        .animated()
        .before(usual_field)
        .after(check_whole_sky)
        .unused_if(unused_field)
        .page({.otherwise = "dome 180, equirect and cylinder 360, pinhole 60", .bounds = "see below"}),
    key<&ViewSettings::tilt_deg>("tilt_deg", "Dome: tilt of the picture.")
        .range(-180.0, 180.0, "deg")
        .animated()
        .unused_if(unused_tilt),
    key<&ViewSettings::artistic_tilt>(
        "artistic_tilt", "`false`: a tilt in the dome setup replaces `tilt_deg`. `true`: the show keeps its own tilt."),
    key<&ViewSettings::from_outside>("from_outside", "`true`: the mirror image, as seen from outside the dome."),
    key<&ViewSettings::vignette>(
        "vignette", "Dome and pinhole: part of the light that is lost at the edge of the picture. See below.")
        .range(0.0, 1.0)
        .animated()
        .written_if([](const ViewSettings& view) { return view.vignette > 0.0; })
        .unused_if(unused_vignette),
    key<&ViewSettings::lens>("lens", "Dome: fisheye lens.").words(lens_names).only_if(only_in<ViewProjection::dome>),
    other<ViewSettings>("polynomial", "Dome: `[f1, f3, f5, f7]` of the lens `polynomial`. See below.")
        .by(read_polynomial, write_polynomial)
        .only_if(only_in<ViewProjection::dome>)
        .fixed(of_the_screen)
        .page({.type = "list of 1 to 4 numbers", .otherwise = "absent", .bounds = "-1e6 to 1e6 each"}),
    table<&ViewSettings::truncation>("truncate", truncation_keys)
        .only_if(only_in<ViewProjection::dome>)
        .fixed(of_the_screen)
        .after([](const TomlTable& table, const ViewSettings& view) {
          if (view.truncation.bottom + view.truncation.top >= 1.0) {
            throw table.error_at("truncate", "removes the whole picture",
                                 "choose bottom and top that add up to less than 1");
          }
        }),
    other<ViewSettings>("viewer", "Dome: position `[right, up, back]` of the viewer for whom the picture is right.")
        .by(read_viewer, write_viewer)
        .only_if(only_in<ViewProjection::dome>)
        .fixed(of_the_screen)
        .page({.type = "list of 3 numbers",
               .unit = "dome radii",
               .otherwise = "`[0, 0, 0]`",
               .bounds = "up to 0.95 from the center"}),
    key<&ViewSettings::cube_files>("cube_layout", "Cube: arrangement of the faces.")
        .words(cube_file_names)
        .only_if(only_in<ViewProjection::cube>),
    key<&ViewSettings::height_deg>("height_deg", "Cylinder: field of view in elevation, symmetric about the horizon.")
        .range(1e-6, 179.0, "deg")
        .only_if(only_in<ViewProjection::cylinder>)
        .fixed(of_the_picture),
    key<&ViewSettings::aspect>("aspect", "Pinhole: width over height.")
        .range(0.01, 100.0)
        .fixed(of_the_picture)
        .unused_if(unused_aspect),
    table<&ViewSettings::frustum>("frustum", frustum_keys)
        .only_if(only_in<ViewProjection::pinhole>)
        .fixed(of_the_screen));

}  // namespace

constinit const KeyTable<ViewSettings> view_keys = keys_of_view;

}  // namespace ergodome
