#include "app/commands/render/frame_check.h"

#include <algorithm>
#include <exception>

#include "app/cli/interrupt.h"
#include "app/cli/progress.h"
#include "kernels/core/error.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

namespace {

//! Number of frames between two reports of progress.
constexpr int frames_at_once = 64;

//! Returns whether a frame is there; false if its files cannot be examined.
bool is_frame_there(const FrameFiles& files, int frame) {
  try {
    return files.is_there(frame);
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

std::vector<int> lacking_frames(const FrameFiles& files, int first, int last) {
  const int count = last - first + 1;
  Progress progress("checking frames", count);
  std::vector<char> there(static_cast<std::size_t>(count), 0);
  std::vector<int> lacking;
  for (int begin = 0; begin < count; begin += frames_at_once) {
    if (interrupted()) {
      throw Error("checking frames", "was stopped", "run the command again");
    }
    const int some = std::min(frames_at_once, count - begin);
    // Each frame is read completely, which is slower than a disk.
    parallel_for(some, 1, [&](int from, int to) {
      for (int i = begin + from; i < begin + to; ++i) {
        there[static_cast<std::size_t>(i)] = is_frame_there(files, first + i) ? 1 : 0;
      }
    });
    for (int i = begin; i < begin + some; ++i) {
      if (there[static_cast<std::size_t>(i)] == 0) {
        lacking.push_back(first + i);
      }
    }
    progress.advance_to(begin + some);
  }
  return lacking;
}

}  // namespace ergodome
