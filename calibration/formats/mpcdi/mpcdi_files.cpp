#include "calibration/formats/mpcdi/mpcdi_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "calibration/formats/mpcdi/mpcdi.h"
#include "calibration/warps/warp_mesh.h"
#include "content/files/whole_file.h"

namespace ergodome {

namespace {

constexpr std::size_t max_map_bytes = 256 + 12 * max_mesh_nodes;
constexpr std::size_t max_mask_bytes = std::size_t{512} << 20U;

//! Returns the path that an element names, in <path> or as its own text, with slashes; nothing if
//! it is empty. Throws Error if it could lead out of the archive.
std::optional<std::string> checked_path(const XmlElement& element) {
  const std::string own_text = element.text();
  std::string path = own_text.empty() || element.child("path") ? element.needed_child("path").text() : own_text;
  // Windows programs write backslashes between folders.
  std::ranges::replace(path, '\\', '/');
  if (path.empty()) {
    return std::nullopt;
  }
  path = std::filesystem::path(path).lexically_normal().generic_string();
  const std::filesystem::path parts(path);
  const bool strange = path.size() > 255 || path.find_first_of(std::string_view(":\0", 2)) != std::string::npos;
  if (strange || parts.is_absolute() || std::find(parts.begin(), parts.end(), "..") != parts.end()) {
    throw element.error(fmt::format("has the path \"{}\", which is not within the calibration", path.substr(0, 80)),
                        "name a file in the archive, or in the folder of the description");
  }
  return path;
}

//! Returns true if two names are equal except for case.
bool same_letters(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

//! Returns the name of a file for messages: the position of the element that names it, then the
//! file's name, whose extension determines the format.
std::string name_of(const XmlElement& element, const std::string& path) { return element.location() + ": " + path; }

MpcdiOrigin origin_of(const std::string& word) {
  // In place of an origin, VESA's library writes a word of <interpolation>; such words count as an
  // unknown origin.
  const auto* const found = std::find(mpcdi_origin_words.begin(), mpcdi_origin_words.end(), word);
  return found == mpcdi_origin_words.end() ? MpcdiOrigin::unknown
                                           : static_cast<MpcdiOrigin>(found - mpcdi_origin_words.begin());
}

//! Returns the unit of a <geometryWarpFile> in lowercase. An unknown unit throws Error if the
//! profile has lengths, and counts as "unknown" otherwise.
std::string unit_of(const XmlElement& element, MpcdiProfile profile) {
  std::string unit = element.text_of("geometricUnit", "unknown");
  std::ranges::transform(unit, unit.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  static const std::set<std::string> units = {"mm", "cm", "dm", "m", "in", "ft", "yd", "unknown"};
  if (!units.contains(unit) && !has_lengths(profile)) {
    // The profile has coordinates on a screen or in an image, which need no unit.
    unit = "unknown";
  } else if (!units.contains(unit)) {
    throw element.error(fmt::format("has the unknown geometricUnit \"{}\"", unit.substr(0, 40)),
                        "use mm, cm, dm, m, in, ft, yd or unknown");
  }
  return unit;
}

}  // namespace

std::optional<FloatMap> MpcdiFileReader::read_map(const XmlElement& element) const {
  const auto path = checked_path(element);
  if (!path) {
    return std::nullopt;
  }
  const std::string bytes = files_(*path, max_map_bytes);
  return parse_float_map(std::as_bytes(std::span(bytes)), name_of(element, *path), order_);
}

std::optional<MpcdiMask> MpcdiFileReader::read_mask(const XmlElement& element) const {
  const auto path = checked_path(element);
  if (!path) {
    return std::nullopt;
  }
  const double gamma = element.number_of("gammaEmbedded", 1.0);
  if (!(gamma >= 0.1 && gamma <= 10.0)) {
    throw element.error(fmt::format("has gammaEmbedded {}", gamma), "write a gamma from 0.1 to 10");
  }
  const std::string bytes = files_(*path, max_mask_bytes);
  return MpcdiMask{parse_blend_map(std::as_bytes(std::span(bytes)), name_of(element, *path)), gamma};
}

std::optional<MpcdiGeometry> MpcdiFileReader::read_geometry(const XmlElement& element, MpcdiProfile profile) const {
  auto map = read_map(element);
  if (!map) {
    return std::nullopt;
  }
  const std::string unit = unit_of(element, profile);
  const std::string interpolation = element.text_of("interpolation", element.text_of("interpolationMethod", "unknown"));
  return MpcdiGeometry{std::move(*map), interpolation, unit, origin_of(element.text_of("originOf3DData", "unknown"))};
}

void MpcdiFileReader::read(const XmlElement& fileset, const Mpcdi& mpcdi, MpcdiRegion& region) const {
  const XmlElement geometry = fileset.needed_child("geometryWarpFile");
  region.unit = unit_of(geometry, mpcdi.profile);
  region.geometry = read_geometry(geometry, mpcdi.profile);
  region.alpha = read_mask(fileset.needed_child("alphaMap"));
  if (mpcdi.color_level > 2) {
    region.beta = read_mask(fileset.needed_child("betaMap"));
  } else if (const auto beta = fileset.child("betaMap")) {
    region.beta = read_mask(*beta);
  }
  if (const auto distortion = fileset.child("distortionMap")) {
    region.distortion = read_map(*distortion);
  }
  if (!region.geometry && !is_posed(mpcdi.profile)) {
    throw fileset.error("names no warp", "profiles 2d and a3 need one: export it again");
  }
  if (region.geometry && mpcdi.profile == MpcdiProfile::shader_lamps &&
      region.geometry->origin == MpcdiOrigin::ideal_eye_point) {
    throw fileset.error("measures 3D data from the idealEyePoint", "profile sl has no such point: write floorCenter");
  }
}

std::filesystem::path file_beside(const std::filesystem::path& folder, const std::string& name) {
  std::filesystem::path found = folder;
  for (const std::filesystem::path& part : std::filesystem::path(name)) {
    std::error_code problem;
    std::filesystem::path next = found / part;
    if (!std::filesystem::exists(next, problem)) {
      const std::filesystem::path in = found.empty() ? "." : found;
      for (std::filesystem::directory_iterator entry(in, problem), end; !problem && entry != end;
           entry.increment(problem)) {
        if (same_letters(entry->path().filename().string(), part.string())) {
          next = found / entry->path().filename();
          break;
        }
      }
    }
    found = next;
  }
  return found;
}

MpcdiFiles files_in_folder(const std::filesystem::path& folder) {
  return [folder](const std::string& name, std::size_t max_bytes) {
    const std::filesystem::path path = file_beside(folder, name);
    std::error_code problem;
    const auto real = std::filesystem::weakly_canonical(path, problem);
    const auto home = std::filesystem::weakly_canonical(folder.empty() ? "." : folder, problem);
    const auto [rest, ignored] = std::mismatch(home.begin(), home.end(), real.begin(), real.end());
    if (problem || rest != home.end()) {
      throw Error(path.string(), "is outside the calibration's folder", "move the file into that folder");
    }
    return read_whole_file(path, max_bytes, "put the file that the calibration names into its folder");
  };
}

}  // namespace ergodome
