#include "app/commands/farm/frame_chunks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ergodome {

namespace {

//! Intended time of a task [s]. A scheduler needs up to a few tenths of a second for a task, and a
//! failed task loses at most its own time.
constexpr double task_s = 120.0;

int divided_up(int count, int by) { return (count + by - 1) / by; }

}  // namespace

int chunk_size(double frame_s, double start_s, int frames) {
  const double wished_s = std::max(task_s, 10.0 * start_s);
  const double fitting = std::ceil(wished_s / std::max(frame_s, 1e-3));
  const int size = static_cast<int>(std::clamp(fitting, 1.0, static_cast<double>(std::max(frames, 1))));
  return std::max(size, divided_up(frames, max_tasks));
}

std::vector<FrameChunk> chunks_of(const FrameChunk& film, int size, const std::vector<int>& to_render) {
  std::vector<FrameChunk> chunks;
  int last_index = -1;
  for (const int frame : to_render) {
    const int index = (frame - film.first) / size;
    if (index != last_index) {
      chunks.push_back({frame, frame});
      last_index = index;
    }
    chunks.back().last = frame;
  }
  return chunks;
}

std::vector<FrameChunk> runs_of(int size, const std::vector<int>& to_render) {
  std::vector<FrameChunk> runs;
  for (const int frame : to_render) {
    if (runs.empty() || runs.back().last + 1 != frame || frame - runs.back().first == size) {
      runs.push_back({frame, frame});
    }
    runs.back().last = frame;
  }
  return runs;
}

std::vector<int> all_frames(const FrameChunk& film) {
  std::vector<int> frames(static_cast<std::size_t>(std::max(film.last - film.first + 1, 0)));
  std::iota(frames.begin(), frames.end(), film.first);
  return frames;
}

std::string text_of(const FrameChunk& chunk) { return fmt::format("{}:{}", chunk.first + 1, chunk.last + 1); }

}  // namespace ergodome
