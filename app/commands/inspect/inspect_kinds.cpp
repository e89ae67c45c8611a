#include "app/commands/inspect/inspect_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string>

#include "calibration/formats/warps/foreign_warp.h"
#include "content/stars/star_file.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

//! What a file is, and what looks into it, told by the ending of its name.
struct OtherKind {
  std::initializer_list<const char*> endings;
  const char* what;
  const char* remedy;  //!< {0}: the file's path, {1}: its name
};

constexpr const char* warp_remedy = "name it in a dome setup, as a projector's warp = \"{1}\", and inspect that";

const OtherKind other_kinds[] = {
    {{".mpcdi"}, "is a calibration", "make a setup of it, and inspect that: ergodome convert {0} dome.toml"},
    {{".data", ".pfm", ".sgc", ".ol", ".simcad"}, "is a warp mesh", warp_remedy},
    {{".csv", ".tsv", ".txt", ".ecsv", ".gz", ".stars"},
     "is no show and no map",
     "look into a catalogue of stars by ergodome catalogue {0}"},
    {{".obj"},
     "is a mesh",
     "name it in a show, as an object's mesh = \"{1}\", or in a dome setup, as a projector's warp = \"{1}\", and "
     "inspect that"},
    {{".gltf", ".glb"}, "is a mesh", "name it in a show, as an object's mesh = \"{1}\", and inspect that"},
    {{".mtl", ".bin"}, "belongs to a mesh", "name that in a show, as an object's mesh, and inspect the show"},
    {{".stl", ".ply", ".fbx", ".blend", ".dae", ".3ds"},
     "is no kind of mesh that is read",
     "export it as a Wavefront OBJ (.obj) or glTF 2 file (.gltf, .glb)"},
    {{".wav", ".flac", ".ogg", ".oga", ".opus", ".mp3"},
     "is sound",
     "name it in a show, as file = \"{1}\" of a table [[audio]], and inspect that"}};

}  // namespace

void require_inspectable(const std::filesystem::path& file) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(file, problem)) {
    return;
  }
  if (const auto format = format_of_content(head_of_file(file));
      format && is_foreign(*format) && *format != WarpFormat::obj) {
    throw Error(file.string(), fmt::format("is {}", name_of(*format)),
                fmt::format(fmt::runtime(warp_remedy), file.string(), file.filename().string()));
  }
  std::string ending = is_star_file(file) ? ".stars" : file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const OtherKind& kind : other_kinds) {
    if (std::ranges::find(kind.endings, ending) != kind.endings.end()) {
      throw Error(file.string(), kind.what,
                  fmt::format(fmt::runtime(kind.remedy), file.string(), file.filename().string()));
    }
  }
}

}  // namespace ergodome
