#include "calibration/formats/mpcdi/mpcdi_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "calibration/formats/mpcdi/mpcdi.h"
#include "calibration/formats/mpcdi/mpcdi_files.h"
#include "calibration/formats/mpcdi/mpcdi_region_reader.h"
#include "calibration/formats/mpcdi/xml_element.h"
#include "calibration/formats/mpcdi/zip_archive.h"
#include "content/files/whole_file.h"

namespace ergodome {

namespace {

constexpr std::size_t max_description_bytes = std::size_t{4} << 20U;
constexpr std::size_t max_archive_bytes = std::size_t{1} << 30U;
constexpr std::size_t max_regions = 256;

std::string shown(const std::string& text) { return text.substr(0, 60); }

class DescriptionReader {
 public:
  DescriptionReader(const XmlFile& xml, MpcdiFiles files, RowOrder order)
      : root_(xml, xml.root()), files_(std::move(files), order) {}

  Mpcdi read() {
    read_head();
    for (const XmlElement& buffer : root_.needed_child("display").children("buffer")) {
      read_buffer(buffer);
    }
    if (regions_.empty()) {
      throw root_.error("has no region", "write a <region> for each projector into <display> and <buffer>");
    }
    read_extensions();
    check_regions();
    read_filesets();
    return std::move(mpcdi_);
  }

 private:
  void read_head() {
    if (!is_mpcdi()) {
      throw root_.error("is not MPCDI", "name a description whose root element is <MPCDI>");
    }
    const std::string profile = root_.needed_attribute("profile");
    const auto* const word = std::find(mpcdi_profile_words.begin(), mpcdi_profile_words.end(), profile);
    if (word == mpcdi_profile_words.end()) {
      throw root_.error(fmt::format("has the unknown profile \"{}\"", shown(profile)), "use 2d, 3d, a3 or sl");
    }
    mpcdi_.profile = static_cast<MpcdiProfile>(word - mpcdi_profile_words.begin());
    read_version();
    mpcdi_.date = root_.attribute("date").value_or("");
  }

  [[nodiscard]] bool is_mpcdi() const {
    std::string name = root_.name();
    std::transform(name.begin(), name.end(), name.begin(), [](char c) { return c >= 'a' && c <= 'z' ? c - 32 : c; });
    return name == "MPCDI";
  }

  //! Reads version and levels. Version 1 has a single level: 2 and 4 have a betaMap, 3 and 4 a warp
  //! for each pixel.
  void read_version() {
    const bool old = root_.attribute("level").has_value();
    const double version = root_.number_attribute("version", old ? 1.0 : 2.0);
    if (!(version >= 1.0 && version < 3.0)) {
      throw root_.error(fmt::format("has the unsupported version {}", version), "export it as version 1 or 2");
    }
    if (old) {
      const int level = root_.whole_attribute("level", 1, 4);
      mpcdi_.version = MpcdiVersion::one;
      mpcdi_.geometry_level = level > 2 ? 2 : 1;
      mpcdi_.color_level = level % 2 == 0 ? 3 : 1;
      return;
    }
    mpcdi_.version = MpcdiVersion::two;
    mpcdi_.geometry_level = root_.whole_attribute("geometry", 1, 2, 1);
    mpcdi_.color_level = root_.whole_attribute("color", 1, 5, 1);
  }

  void read_buffer(const XmlElement& element) {
    if (is_posed(mpcdi_.profile) && !mpcdi_.buffers.empty()) {
      throw element.error("is a second buffer", "profiles 3d and sl have one buffer: put every region into it");
    }
    MpcdiBuffer buffer;
    buffer.id = element.attribute("id").value_or("");
    buffer.resolution_x = element.whole_attribute("xResolution", 0, 1 << 20, 0);
    buffer.resolution_y = element.whole_attribute("yResolution", 0, 1 << 20, 0);
    const auto position = mpcdi_.buffers.size();
    for (const XmlElement& region : element.children("region")) {
      buffer.regions.push_back(read_mpcdi_region(region, mpcdi_.left_out));
      const auto [at, added] =
          regions_.emplace(buffer.regions.back().id, Found{position, buffer.regions.size() - 1, region});
      if (!added) {
        throw region.error(fmt::format("has the id \"{}\" of another region", shown(at->first)),
                           "give each region its own id");
      }
      if (regions_.size() > max_regions) {
        throw region.error("is one region too many", fmt::format("use at most {} regions", max_regions));
      }
    }
    mpcdi_.buffers.push_back(std::move(buffer));
  }

  void read_extensions() {
    const auto set = root_.child("extensionSet");
    if (!set) {
      return;
    }
    for (const XmlElement& extension : set->children("extension")) {
      if (extension.attribute("Name").value_or("") != "BufferExtension") {
        continue;
      }
      for (const XmlElement& buffer : extension.children("buffer")) {
        for (const XmlElement& region : buffer.children("region")) {
          if (auto lens = read_mpcdi_lens(region)) {
            region_named(region.needed_attribute("id"), region).fisheye = lens;
          }
        }
      }
    }
  }

  MpcdiRegion& region_named(const std::string& id, const XmlElement& asking) {
    const auto at = regions_.find(id);
    if (at == regions_.end()) {
      throw asking.error(fmt::format("refers to region \"{}\", which does not exist", shown(id)), "correct the id");
    }
    return mpcdi_.buffers[at->second.buffer].regions[at->second.index];
  }

  void check_regions() {
    for (const auto& [id, found] : regions_) {
      check_mpcdi_region(region_named(id, found.element), mpcdi_.profile, found.element);
    }
  }

  void read_filesets() {
    std::vector<XmlElement> filesets = root_.children("fileset");
    for (const XmlElement& files : root_.children("files")) {
      const auto within = files.children("fileset");
      filesets.insert(filesets.end(), within.begin(), within.end());
    }
    std::set<std::string> seen;
    const auto read = [&](const XmlElement& fileset, const std::string& id) {
      MpcdiRegion& region = region_named(id, fileset);
      if (!seen.insert(id).second) {
        throw fileset.error(fmt::format("is the second <fileset> of region \"{}\"", shown(id)),
                            "write one <fileset> for each region");
      }
      files_.read(fileset, mpcdi_, region);
      if (has_lengths(mpcdi_.profile) && region.unit == "unknown") {
        mpcdi_.left_out.push_back(
            fmt::format("{}: no geometricUnit, so lengths are assumed to be in meters", fileset.location()));
      }
    };
    for (const XmlElement& fileset : filesets) {
      read(fileset, fileset.needed_attribute("region"));
    }
    // Some programs write a region's fileset inside the region, where it need not name the region.
    for (const auto& [id, found] : regions_) {
      for (const XmlElement& fileset : found.element.children("fileset")) {
        const std::string named = fileset.attribute("region").value_or(id);
        if (named != id) {
          throw fileset.error(fmt::format("is in region \"{}\" but names region \"{}\"", shown(id), shown(named)),
                              "name the region that contains it, or leave out the name");
        }
        read(fileset, id);
      }
    }
    for (const auto& [id, found] : regions_) {
      if (!is_posed(mpcdi_.profile) && !seen.contains(id)) {
        throw found.element.error("has no <fileset>", "profiles 2d and a3 need a warp for every region");
      }
    }
  }

  struct Found {
    std::size_t buffer;
    std::size_t index;
    XmlElement element;
  };

  XmlElement root_;
  MpcdiFileReader files_;
  Mpcdi mpcdi_;
  std::map<std::string, Found> regions_;
};

}  // namespace

double metres_of_unit(const std::string& unit) {
  static const std::map<std::string, double> metres = {{"mm", 0.001},  {"cm", 0.01},   {"dm", 0.1},   {"m", 1.0},
                                                       {"in", 0.0254}, {"ft", 0.3048}, {"yd", 0.9144}};
  const auto at = metres.find(unit);
  return at != metres.end() ? at->second : 1.0;
}

Mpcdi parse_mpcdi_description(std::string_view xml, const std::string& name, const MpcdiFiles& files, RowOrder order) {
  if (xml.size() > max_description_bytes) {
    throw Error(name, "is a description of more than 4 MiB", "export it again");
  }
  const XmlFile parsed(xml, name);
  return DescriptionReader(parsed, files, order).read();
}

Mpcdi parse_mpcdi_archive(std::span<const std::byte> bytes, const std::string& name, RowOrder order) {
  ZipArchive archive(bytes, name);
  const std::string description = archive.has("mpcdi.xml") ? "mpcdi.xml" : "mpacs.xml";
  if (!archive.has(description)) {
    throw Error(name, "contains no mpcdi.xml at its top level",
                "name an MPCDI archive, or pack its files without a folder");
  }
  const std::string xml = archive.read(description, max_description_bytes);
  const auto files = [&](const std::string& member, std::size_t max_bytes) { return archive.read(member, max_bytes); };
  return parse_mpcdi_description(xml, name + ": " + description, files, order);
}

Mpcdi read_mpcdi(const std::filesystem::path& path, RowOrder order) {
  const std::string bytes = read_whole_file(path, max_archive_bytes, "name an MPCDI archive or its description in XML");
  if (bytes.starts_with("PK")) {
    return parse_mpcdi_archive(std::as_bytes(std::span(bytes)), path.string(), order);
  }
  return parse_mpcdi_description(bytes, path.string(), files_in_folder(path.parent_path()), order);
}

std::vector<std::filesystem::path> files_of_mpcdi(const std::filesystem::path& path) {
  const std::string bytes = read_whole_file(path, max_archive_bytes, "name an MPCDI archive or its description in XML");
  std::vector<std::filesystem::path> named;
  if (!bytes.starts_with("PK")) {
    const MpcdiFiles files = files_in_folder(path.parent_path());
    const auto noted = [&](const std::string& name, std::size_t max_bytes) {
      const std::filesystem::path beside = file_beside(path.parent_path(), name);
      if (std::ranges::find(named, beside) == named.end()) {
        named.push_back(beside);
      }
      return files(name, max_bytes);
    };
    parse_mpcdi_description(bytes, path.string(), noted, RowOrder::bottom_up);
  }
  return named;
}

}  // namespace ergodome
