#include "render/output/frame_names.h"

#include <fmt/format.h>

#include "render/picture/cube_pictures.h"

namespace ergodome {

std::filesystem::path eye_folder(FramePart part) {
  return part == FramePart::whole ? "" : part == FramePart::left ? "L" : "R";
}

std::filesystem::path frame_path(const std::string& name, int index, int frames_in_show, FramePart part,
                                 const std::string& ending, std::optional<CubeFace> face) {
  constexpr int frames_a_folder = 10'000;
  std::filesystem::path path = eye_folder(part);
  if (frames_in_show > frames_a_folder) {
    const int first = index / frames_a_folder * frames_a_folder + 1;
    const int last = first + frames_a_folder - 1;
    path /= fmt::format("{}_{:06}_{:03},{:03}", name, first, last / 1000, last % 1000);
  }
  const std::string face_name = face ? cube_face_name(*face) : std::string();
  return path / fmt::format("{}_{:06}{}{}.{}", name, index + 1, face ? "_" : "", face_name, ending);
}

}  // namespace ergodome
