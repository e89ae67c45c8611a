#include "app/commands/render/frame_check.h"

#include "app/cli/interrupt.h"
#include "app/cli/progress.h"
#include "kernels/core/error.h"

namespace ergodome {

std::vector<int> lacking_frames(const FrameFiles& files, int first, int last) {
  Progress progress("checking frames", last - first + 1);
  std::vector<int> lacking;
  for (int frame = first; frame <= last; ++frame) {
    if (interrupted()) {
      throw Error("checking frames", "was stopped", "run the command again");
    }
    if (!files.is_there(frame)) {
      lacking.push_back(frame);
    }
    progress.advance_to(frame - first + 1);
  }
  return lacking;
}

}  // namespace ergodome
