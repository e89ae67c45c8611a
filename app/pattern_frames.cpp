#include "app/pattern_frames.h"

#include <filesystem>

#include "content/files/atomic_file.h"
#include "render/frame/cube_pictures.h"
#include "render/frame/view_projection.h"
#include "render/output/frame_names.h"
#include "render/patterns/test_pattern.h"

namespace ergodome {

int write_pattern_frames(const PatternFrames& frames, const Show& show) {
  const std::vector<std::string> names =
      frames.pattern == "all" ? test_pattern_names() : std::vector<std::string>{frames.pattern};
  const Projection projection =
      make_projection(show.view, frames.size_px > 0 ? frames.size_px : show.view.size_px, 0.0);
  const std::vector<FramePart> eyes = show.stereo.layout == StereoLayout::mono
                                          ? std::vector<FramePart>{FramePart::whole}
                                          : std::vector<FramePart>{FramePart::left, FramePart::right};
  int written = 0;
  for (const std::string& name : names) {
    for (const FramePart eye : eyes) {
      const std::filesystem::path path =
          std::filesystem::path(frames.out) / eye_folder(eye) / (name + '.' + file_ending(frames.format.image));
      make_folder(path.parent_path());
      const FrameMetadata metadata = {{"pattern", name}};
      write_picture(path, frames.format, draw_test_pattern(test_pattern(name), projection, eye), metadata);
      ++written;
    }
  }
  return written;
}

}  // namespace ergodome
