#include "app/commands/render/run_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <vector>

#include "app/cli/summary_text.h"
#include "kernels/core/error.h"
#include "render/output/color_bar.h"
#include "render/output/image_writer.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

//! A new folder that is removed with its contents.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "ergodome-plan-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw Error(name, "cannot be created", "free some space there, or set TMPDIR to another folder");
    }
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

RunFrameCost cost_of(ShowRenderer& renderer, const ViewChoice& choice, const FrameFormat& format, int frame) {
  const ScratchFolder folder;
  const auto begin = std::chrono::steady_clock::now();
  std::vector<FrameImage> images = renderer.render(frame_time_s(renderer.show(), frame), choice);
  for (FrameImage& image : images) {
    draw_color_bar(image.picture, choice.mode);
  }
  const bool views = renderer.show().stereo.layout == StereoLayout::multiview && images.size() > 1;
  RunFrameCost cost;
  for (std::size_t i = 0; i < images.size(); i += views ? 2 : 1) {
    const fs::path file = folder.path() / fmt::format("{}.{}", i, file_ending(format.image));
    if (views) {
      write_views(file, format, images[i].picture, images[i + 1].picture, {});
    } else {
      write_picture(file, format, images[i].picture, {});
    }
    cost.bytes += fs::file_size(file);
  }
  cost.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return cost;
}

}  // namespace

std::string run_cost_text(long frames, const RunFrameCost& frame) {
  const double bytes = static_cast<double>(frames) * static_cast<double>(frame.bytes);
  const std::string size = size_text(static_cast<std::uintmax_t>(std::min(bytes, 1e18)));
  if (frames == 1) {
    return fmt::format("1 frame: about {}, {}", duration_text(frame.seconds), size);
  }
  return fmt::format("{} frames, about {} each: {}, {}", grouped(frames), duration_text(frame.seconds),
                     duration_text(static_cast<double>(frames) * frame.seconds), size);
}

std::string room_note(const std::string& folder, const std::string& what, std::uintmax_t needed_bytes,
                      std::uintmax_t left_bytes) {
  if (needed_bytes <= left_bytes) {
    return "";
  }
  return fmt::format("{}: {} needs about {}, but its disk has only {} free; free some space or choose another --out",
                     folder, what, size_text(needed_bytes), size_text(left_bytes));
}

std::uintmax_t free_bytes(const fs::path& folder) {
  fs::path there = fs::absolute(folder).lexically_normal();
  while (!fs::exists(there) && there.has_relative_path()) {
    there = there.parent_path();
  }
  return fs::space(there).available;
}

double min_compressed_part(const FrameFormat& format) {
  const bool uncompressed = format.image == ImageFormat::exr && format.compression == ExrCompression::none;
  return uncompressed ? 1.0 : 0.1;
}

std::uintmax_t uncompressed_bytes(const FrameFormat& format, std::uintmax_t pixels) {
  const std::uintmax_t channel_bytes = format.image == ImageFormat::png ? 1 : 2;
  return pixels * (format.alpha ? 4 : 3) * channel_bytes;
}

MeasuredFrame measured_frame(ShowRenderer& renderer, const ViewChoice& choice, const FrameFormat& format, int frame,
                             double slow_s) {
  if (frame > 0) {
    const RunFrameCost before = cost_of(renderer, choice, format, frame - 1);
    if (before.seconds >= slow_s) {
      return {frame - 1, before};
    }
  }
  return {frame, cost_of(renderer, choice, format, frame)};
}

}  // namespace ergodome
