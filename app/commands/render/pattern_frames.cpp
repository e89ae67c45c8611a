#include "app/commands/render/pattern_frames.h"

#include <filesystem>
#include <utility>

#include "content/files/atomic_file.h"
#include "render/eyes/view_projection.h"
#include "render/output/frame_files.h"
#include "render/output/stereo_layout.h"
#include "render/patterns/test_pattern.h"
#include "render/picture/cube_pictures.h"

namespace ergodome {

namespace {

//! Draws a pattern for a stereo layout: as two pictures if the layout stores the eyes separately
//! (keeps_eyes_apart()), otherwise as one.
std::vector<FrameImage> pattern_images(TestPattern pattern, const Projection& projection,
                                       const StereoSettings& stereo) {
  if (stereo.layout == StereoLayout::mono) {
    return {{FramePart::whole, draw_test_pattern(pattern, projection)}};
  }
  Picture left = draw_test_pattern(pattern, projection, FramePart::left);
  Picture right = draw_test_pattern(pattern, projection, FramePart::right);
  if (stereo.tint_eyes) {
    tint_left_eye(left);
    tint_right_eye(right);
  }
  if (stereo.swap_eyes) {
    std::swap(left, right);
  }
  if (keeps_eyes_apart(stereo.layout)) {
    return {{FramePart::left, std::move(left)}, {FramePart::right, std::move(right)}};
  }
  return {{FramePart::whole, joined_eyes(left, right, stereo.layout)}};
}

}  // namespace

int write_pattern_frames(const PatternFrames& frames, const Show& show) {
  const std::vector<std::string> names =
      frames.pattern == "all" ? test_pattern_names() : std::vector<std::string>{frames.pattern};
  const Projection projection =
      make_projection(show.view, frames.size_px > 0 ? frames.size_px : show.view.size_px, 0.0);
  int written = 0;
  for (const std::string& name : names) {
    const std::vector<FrameImage> images = pattern_images(test_pattern(name), projection, show.stereo);
    const FrameMetadata metadata = {{"pattern", name}};
    const bool views = show.stereo.layout == StereoLayout::multiview;
    for (const FrameImage& image : images) {
      const std::filesystem::path path = std::filesystem::path(frames.out) /
                                         eye_folder(views ? FramePart::whole : image.part) /
                                         (name + '.' + file_ending(frames.format.image));
      make_folder(path.parent_path());
      ++written;
      if (views) {
        write_views(path, frames.format, images[0].picture, images[1].picture, metadata);
        break;
      }
      write_picture(path, frames.format, image.picture, metadata);
    }
  }
  return written;
}

}  // namespace ergodome
