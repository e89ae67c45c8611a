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

//! A kind of file that `inspect` does not support, recognized by its ending, and what to do
//! instead.
struct OtherKind {
  std::initializer_list<const char*> endings;
  const char* what;
  const char* remedy;  //!< {0}: the file's path, {1}: its name
};

constexpr const char* warp_remedy = "use it in a dome setup, as a projector's warp = \"{1}\", and inspect the setup";

const OtherKind other_kinds[] = {
    {{".mpcdi"}, "is a calibration", "convert it to a dome setup and inspect that: ergodome convert {0} dome.toml"},
    {{".data", ".pfm", ".sgc", ".ol", ".simcad"}, "is a warp mesh", warp_remedy},
    {{".csv", ".tsv", ".txt", ".ecsv", ".gz", ".stars"},
     "is neither a show nor a sky map",
     "if it is a star catalogue, run ergodome catalogue {0}"},
    {{".obj"},
     "is a mesh",
     "use it in a show, as an object's mesh = \"{1}\", or in a dome setup, as a projector's warp = \"{1}\", and "
     "inspect that file"},
    {{".gltf", ".glb"}, "is a mesh", "use it in a show, as an object's mesh = \"{1}\", and inspect the show"},
    {{".mtl", ".bin"}, "belongs to a mesh", "use the mesh in a show, as an object's mesh, and inspect the show"},
    {{".stl", ".ply", ".fbx", ".blend", ".dae", ".3ds"},
     "is a mesh of an unsupported format",
     "export it as a Wavefront OBJ (.obj) or glTF 2 file (.gltf, .glb)"},
    {{".wav", ".flac", ".ogg", ".oga", ".opus", ".mp3"},
     "is a sound file",
     "use it in a show, as file = \"{1}\" in an [[audio]] table, and inspect the show"}};

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
