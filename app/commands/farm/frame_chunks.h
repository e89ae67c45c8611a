#pragma once

#include <string>
#include <vector>

#include "app/commands/farm/farm_plan.h"

namespace ergodome {

//! Maximum number of tasks in a step: Slurm's default limit for arrays.
inline constexpr int max_tasks = 1000;

//! Returns the number of frames in a task, so that a task takes about two minutes and its start less
//! than a tenth of its time, within max_tasks. `frame_s` is the time of a frame, `start_s` that of
//! the program's start.
int chunk_size(double frame_s, double start_s, int frames);

//! Divides a film into chunks of `size` frames, and returns those that contain frames to render
//! (sorted, counted from 0), cut to the first and last of them.
std::vector<FrameChunk> chunks_of(const FrameChunk& film, int size, const std::vector<int>& to_render);

//! Divides each range of adjacent frames (sorted, counted from 0) into chunks of `size` frames from
//! its beginning, as Open Job Description does.
std::vector<FrameChunk> runs_of(int size, const std::vector<int>& to_render);

//! Returns all frames of a film.
std::vector<int> all_frames(const FrameChunk& film);

//! Returns a chunk as text for --frames: "13:24".
std::string text_of(const FrameChunk& chunk);

}  // namespace ergodome
