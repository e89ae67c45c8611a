#include "app/commands/movie/spherical_metadata.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>

#include "app/commands/movie/film_file.h"
#include "app/commands/movie/matroska_video.h"
#include "app/commands/movie/mp4_boxes.h"

namespace ergodome {

namespace {

constexpr double whole_turn_deg = 360.0;
//! Version and flags of a box.
constexpr std::string_view no_flags("\0\0\0\0", 4);

//! Returns the parts of a whole sphere that the picture lacks at the top, bottom, left and right.
//! MP4 and Matroska both store them after four bytes of version and flags. Readers divide the
//! numbers by 2^32 - 1.
std::string equirectangular_bounds(const SphericalFilm& sphere) {
  constexpr double one = std::numeric_limits<std::uint32_t>::max();
  const double missing = 0.5 * (1.0 - std::clamp(sphere.azimuth_deg / whole_turn_deg, 0.0, 1.0));
  const auto bound = static_cast<std::uint64_t>(missing * one);
  std::string bounds(no_flags);
  for (const std::uint64_t each : {std::uint64_t{0}, std::uint64_t{0}, bound, bound}) {
    append_big_endian(bounds, each, 4);
  }
  return bounds;
}

//! Returns the boxes of Spherical Video V2, with the front of the view at the front of the sphere.
std::string spherical_boxes(const SphericalFilm& sphere) {
  std::string stereo(no_flags);
  stereo += static_cast<char>(sphere.eyes);
  const std::string maker = std::string(no_flags) + "Ergodome " ERGODOME_VERSION + '\0';
  const std::string pose = std::string(no_flags) + std::string(12, '\0');
  const std::string projection = mp4_box("prhd", pose) + mp4_box("equi", equirectangular_bounds(sphere));
  return mp4_box("st3d", stereo) + mp4_box("sv3d", mp4_box("svhd", maker) + mp4_box("proj", projection));
}

//! Returns the box of Spherical Video V1.
std::string older_spherical_box(const SphericalFilm& sphere) {
  constexpr const char* modes[] = {"mono", "top-bottom", "left-right"};
  constexpr std::string_view id("\xff\xcc\x82\x63\xf8\x55\x4a\x93\x88\x14\x58\x7a\x02\x52\x1f\xdd", 16);
  return mp4_box(
      "uuid",
      std::string(id) + fmt::format("<?xml version=\"1.0\"?>"
                                    "<rdf:SphericalVideo xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\" "
                                    "xmlns:GSpherical=\"http://ns.google.com/videos/1.0/spherical/\">"
                                    "<GSpherical:Spherical>true</GSpherical:Spherical>"
                                    "<GSpherical:Stitched>true</GSpherical:Stitched>"
                                    "<GSpherical:StitchingSoftware>Ergodome " ERGODOME_VERSION
                                    "</GSpherical:StitchingSoftware>"
                                    "<GSpherical:ProjectionType>equirectangular</GSpherical:ProjectionType>"
                                    "<GSpherical:StereoMode>{}</GSpherical:StereoMode>"
                                    "</rdf:SphericalVideo>",
                                    modes[static_cast<std::size_t>(sphere.eyes)]));
}

std::string projection_element(const SphericalFilm& sphere) {
  constexpr std::uint32_t projection_id = 0x7670U;
  constexpr std::uint32_t type_id = 0x7671U;
  constexpr std::uint32_t private_id = 0x7672U;
  constexpr char equirectangular_type = 1;
  return matroska_element(projection_id, matroska_element(type_id, std::string(1, equirectangular_type)) +
                                             matroska_element(private_id, equirectangular_bounds(sphere)));
}

}  // namespace

std::optional<SphericalFilm> spherical_film(const Show& show) {
  const ViewSettings& view = show.view;
  const StereoLayout layout = show.stereo.layout;
  if (view.projection != ViewProjection::equirect || view.from_outside || layout == StereoLayout::rows) {
    return std::nullopt;
  }
  SphericalFilm sphere;
  sphere.azimuth_deg = view.field_of_view_deg;
  if (layout == StereoLayout::top_bottom || layout == StereoLayout::half_top_bottom) {
    sphere.eyes = SphericalFilm::Eyes::top_bottom;
  } else if (layout == StereoLayout::side_by_side || layout == StereoLayout::half_side_by_side) {
    sphere.eyes = SphericalFilm::Eyes::left_right;
  }
  if (sphere.eyes != SphericalFilm::Eyes::one && show.stereo.swap_eyes) {
    return std::nullopt;
  }
  return sphere;
}

std::vector<std::string> spherical_arguments(const SphericalFilm& sphere, const std::string& ending) {
  if (ending != ".mkv") {
    return {};
  }
  constexpr const char* modes[] = {"mono", "top_bottom", "left_right"};
  return {"-metadata:s:v:0", std::string("stereo_mode=") + modes[static_cast<std::size_t>(sphere.eyes)],
          "-metadata:s:v:0", "title=" + reserving_title(),
          "-write_crc32",    "0"};
}

void add_spherical_metadata(const std::filesystem::path& partial, const std::string& film, const std::string& ending,
                            const SphericalFilm& sphere) {
  FilmFile file(partial, film);
  if (ending == ".mkv") {
    add_to_video(file, projection_element(sphere));
  } else {
    const bool whole = sphere.azimuth_deg >= whole_turn_deg;
    insert_boxes(file, {spherical_boxes(sphere), whole ? older_spherical_box(sphere) : ""});
  }
}

}  // namespace ergodome
