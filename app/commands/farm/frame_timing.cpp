#include "app/commands/farm/frame_timing.h"

#include <chrono>

#include "app/cli/backend_choice.h"
#include "app/cli/interrupt.h"
#include "app/commands/channels/heat_map_options.h"
#include "app/commands/render/frame_files.h"
#include "app/commands/render/run_cost.h"
#include "kernels/core/error.h"
#include "render/frame/show_renderer.h"

namespace ergodome {

namespace {

constexpr double max_timing_s = 60.0;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

FrameTiming time_frames(const RenderOptions& options, const Show& show, const FrameChunk& film) {
  const auto begin = std::chrono::steady_clock::now();
  const Backend backend = choose_backend(options.backend);
  LensOptions lens = options.lens;
  std::error_code problem;
  if (!std::filesystem::exists(lens.trajectory, problem)) {
    // The tasks bake it; until then, frames use the lenses without it.
    lens.trajectory.clear();
  }
  ShowRenderer renderer(show, backend, lens_choice(lens), open_stream(show, lens, backend));
  const ViewChoice choice = {
      view_mode(options.view), options.size_px, follow_method(options.method, options.view, show),
      view_range(options.view_range, view_mode(options.view), !options.method.empty()), options.alpha};
  FrameTiming timing;
  timing.start_s = seconds_since(begin);
  const int count = film.last - film.first + 1;
  int measured = 0;
  double sum_s = 0.0;
  for (const int sixth : {1, 3, 5}) {
    if (interrupted()) {
      throw Error("farm", "was stopped", "run it again");
    }
    sum_s += measured_frame(renderer, choice, format_of(options), film.first + count * sixth / 6).cost.seconds;
    timing.frame_s = sum_s / ++measured;
    if (seconds_since(begin) > max_timing_s) {
      break;
    }
  }
  return timing;
}

}  // namespace ergodome
