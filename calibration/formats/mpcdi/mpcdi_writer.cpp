#include "calibration/formats/mpcdi/mpcdi_writer.h"

#include <fmt/format.h>

#include <optional>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <utility>

#include "calibration/formats/mpcdi/mpcdi.h"
#include "calibration/formats/mpcdi/zip_archive.h"
#include "content/files/atomic_file.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

std::string number(double value) { return fmt::format("{}", value); }

void add(pugi::xml_node parent, const char* name, const std::string& text) {
  parent.append_child(name).text().set(text.c_str());
}

void set(pugi::xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name).set_value(value.c_str());
}

class ArchiveWriter {
 public:
  ArchiveWriter(const Mpcdi& mpcdi, const std::string& name) : mpcdi_(mpcdi), name_(name) {}

  std::string write() {
    pugi::xml_node declaration = document_.append_child(pugi::node_declaration);
    set(declaration, "version", "1.0");
    set(declaration, "encoding", "UTF-8");
    pugi::xml_node root = document_.append_child("MPCDI");
    write_head(root);
    pugi::xml_node display = root.append_child("display");
    pugi::xml_node files = root.append_child("files");
    for (const MpcdiBuffer& buffer : mpcdi_.buffers) {
      pugi::xml_node element = display.append_child("buffer");
      set(element, "id", buffer.id);
      if (buffer.resolution_x > 0 && buffer.resolution_y > 0) {
        set(element, "xResolution", number(buffer.resolution_x));
        set(element, "yResolution", number(buffer.resolution_y));
      }
      for (const MpcdiRegion& region : buffer.regions) {
        check(region);
        write_region(element, region);
        write_files(files, region);
      }
    }
    write_lenses(root);
    std::ostringstream text;
    document_.save(text, "  ", pugi::format_default, pugi::encoding_utf8);
    members_.insert(members_.begin(), {"mpcdi.xml", text.str()});
    return zip_of(members_, name_);
  }

 private:
  void write_head(pugi::xml_node root) {
    set(root, "profile", std::string(mpcdi_profile_words[static_cast<std::size_t>(mpcdi_.profile)]));
    if (mpcdi_.version == MpcdiVersion::one) {
      set(root, "level", number((mpcdi_.geometry_level > 1 ? 3 : 1) + (mpcdi_.color_level > 2 ? 1 : 0)));
    } else {
      set(root, "geometry", number(mpcdi_.geometry_level));
      set(root, "color", number(mpcdi_.color_level));
    }
    set(root, "date", mpcdi_.date);
    set(root, "version", mpcdi_.version == MpcdiVersion::one ? "1.0" : "2.0");
  }

  void check(const MpcdiRegion& region) {
    const auto lacks = [&](const std::string& what) {
      return Error(name_, fmt::format("cannot store region \"{}\" without {}", region.id, what), "add it");
    };
    if (!ids_.insert(region.id).second || region.id.empty()) {
      throw Error(name_,
                  fmt::format("cannot store a region with the id \"{}\", which is empty or used twice", region.id),
                  "give each region its own id");
    }
    if (is_posed(mpcdi_.profile) && !(region.frustum && region.orientation)) {
      throw lacks("a frustum");
    }
    if (mpcdi_.profile == MpcdiProfile::shader_lamps && !region.frame) {
      throw lacks("a coordinate frame");
    }
    if (!is_posed(mpcdi_.profile) && !region.geometry) {
      throw lacks("a warp");
    }
  }

  static void write_frustum(pugi::xml_node parent, const Orientation& turned, const Frustum& frustum) {
    pugi::xml_node element = parent.append_child("frustum");
    add(element, "yaw", number(turned.yaw_deg));
    add(element, "pitch", number(turned.pitch_deg));
    add(element, "roll", number(turned.roll_deg));
    add(element, "rightAngle", number(frustum.right_deg));
    add(element, "leftAngle", number(frustum.left_deg));
    add(element, "upAngle", number(frustum.up_deg));
    add(element, "downAngle", number(frustum.down_deg));
  }

  //! Writes a gamma if it is set; an absent gamma differs from a gamma of 1.
  static void write_gamma(pugi::xml_node color, const char* name, const std::optional<double>& gamma) {
    if (gamma) {
      pugi::xml_node element = color.append_child(name);
      set(element, "type", "gamma");
      set(element, "gamma", number(*gamma));
    }
  }

  static void write_region(pugi::xml_node parent, const MpcdiRegion& region) {
    pugi::xml_node element = parent.append_child("region");
    set(element, "id", region.id);
    set(element, "x", number(region.x));
    set(element, "y", number(region.y));
    set(element, "xSize", number(region.width));
    set(element, "ySize", number(region.height));
    set(element, "xResolution", number(region.resolution_x));
    set(element, "yResolution", number(region.resolution_y));
    if (region.frustum && region.orientation) {
      write_frustum(element, *region.orientation, *region.frustum);
    }
    if (region.frame) {
      pugi::xml_node frame = element.append_child("coordinateFrame");
      for (const MpcdiFrameNumber& each : mpcdi_frame_numbers) {
        add(frame, std::string(each.tag).c_str(), number(*region.frame.*each.vector.*each.component));
      }
    }
    if (region.decode_gamma || region.encode_gamma) {
      pugi::xml_node color = element.append_child("color");
      write_gamma(color, "decode", region.decode_gamma);
      write_gamma(color, "encode", region.encode_gamma);
    }
  }

  //! Adds a member with these bytes to the archive, and returns its name.
  std::string member(const char* kind, const char* ending, std::string bytes) {
    members_.emplace_back(fmt::format("{}{}.{}", kind, ids_.size(), ending), std::move(bytes));
    return members_.back().first;
  }

  pugi::xml_node write_mask(pugi::xml_node fileset, const char* kind, const MpcdiMask* mask) {
    pugi::xml_node element = fileset.append_child(kind);
    add(element, "path", mask != nullptr ? member(kind, "png", to_png(mask->map, name_ + ": " + kind + ".png")) : "");
    add(element, "bitDepth", number(mask != nullptr ? mask->map.bit_depth : 8));
    add(element, "componentDepth", number(mask != nullptr ? mask->map.channels : 1));
    return element;
  }

  void write_files(pugi::xml_node files, const MpcdiRegion& region) {
    pugi::xml_node fileset = files.append_child("fileset");
    set(fileset, "region", region.id);
    const MpcdiGeometry* const geometry = region.geometry ? &*region.geometry : nullptr;
    pugi::xml_node warp = fileset.append_child("geometryWarpFile");
    add(warp, "path",
        geometry != nullptr ? member("warp", "pfm", to_float_map_file(geometry->map, RowOrder::bottom_up)) : "");
    add(warp, "interpolation", geometry != nullptr ? geometry->interpolation : "unknown");
    if (mpcdi_.profile == MpcdiProfile::advanced_3d || mpcdi_.profile == MpcdiProfile::shader_lamps) {
      const auto origin = static_cast<std::size_t>(geometry != nullptr ? geometry->origin : MpcdiOrigin::unknown);
      add(warp, "geometricUnit", geometry != nullptr ? geometry->unit : region.unit);
      add(warp, "originOf3DData", std::string(mpcdi_origin_words[origin]));
    }
    const MpcdiMask* const alpha = region.alpha ? &*region.alpha : nullptr;
    pugi::xml_node element = write_mask(fileset, "alphaMap", alpha);
    add(element, "gammaEmbedded", number(alpha != nullptr ? alpha->gamma_embedded : 1.0));
    if (region.beta || mpcdi_.color_level > 2) {
      write_mask(fileset, "betaMap", region.beta ? &*region.beta : nullptr);
    }
    if (region.distortion) {
      add(fileset.append_child("distortionMap"), "path",
          member("distortion", "pfm", to_float_map_file(*region.distortion, RowOrder::bottom_up)));
    }
  }

  static void write_lens(pugi::xml_node parent, const MpcdiRegion& region) {
    pugi::xml_node element = parent.append_child("region");
    set(element, "id", region.id);
    pugi::xml_node fisheye = element.append_child("fisheye");
    add(fisheye, "horizontalOffset", number(region.fisheye->horizontal_offset));
    add(fisheye, "verticalOffset", number(region.fisheye->vertical_offset));
    constexpr const char* names[] = {"f1", "f3", "f5", "f7"};
    for (std::size_t i = 0; i < 4; ++i) {
      add(fisheye, names[i], number(region.fisheye->coefficients[i]));
    }
    pugi::xml_node anamorphic = element.append_child("anamorphic");
    add(anamorphic, "angle", number(region.fisheye->anamorphic_angle_deg));
    add(anamorphic, "ratio", number(region.fisheye->anamorphic_ratio));
  }

  void write_lenses(pugi::xml_node root) {
    pugi::xml_node extension;
    for (const MpcdiBuffer& buffer : mpcdi_.buffers) {
      pugi::xml_node element;
      for (const MpcdiRegion& region : buffer.regions) {
        if (!region.fisheye) {
          continue;
        }
        if (!extension) {
          extension = root.append_child("extensionSet").append_child("extension");
          set(extension, "Name", "BufferExtension");
          set(extension, "hasExternalFiles", "false");
        }
        if (!element) {
          element = extension.append_child("buffer");
          set(element, "id", buffer.id);
        }
        write_lens(element, region);
      }
    }
  }

  const Mpcdi& mpcdi_;
  const std::string& name_;
  pugi::xml_document document_;
  std::vector<std::pair<std::string, std::string>> members_;
  std::set<std::string> ids_;
};

}  // namespace

std::string to_mpcdi_archive(const Mpcdi& mpcdi, const std::string& name) { return ArchiveWriter(mpcdi, name).write(); }

void write_mpcdi(const std::filesystem::path& path, const Mpcdi& mpcdi) {
  write_text_atomically(path, to_mpcdi_archive(mpcdi, path.string()));
}

}  // namespace ergodome
