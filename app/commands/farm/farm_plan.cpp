#include "app/commands/farm/farm_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "app/commands/farm/farm_film.h"
#include "app/commands/farm/farm_folder.h"
#include "app/commands/farm/frame_chunks.h"
#include "app/commands/farm/openjd_template.h"
#include "app/commands/farm/shell_words.h"
#include "app/commands/render/render_request.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

//! Returns the command of a step that renders or checks frames.
std::vector<std::string> render_words(const FarmFilm& film, std::initializer_list<std::string> more) {
  std::vector<std::string> words = {"render", film.options.show, "--out=" + film.options.out};
  words.insert(words.end(), film.words.begin(), film.words.end());
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

//! Returns the option with which frames follow the measured light; empty if the exposure is not
//! automatic.
std::vector<std::string> light_words(const FarmFilm& film) {
  return follows_exposure(film.options, film.show)
             ? std::vector<std::string>{"--light=" + FarmFolder(film.options.out).light().string()}
             : std::vector<std::string>{};
}

void add_bake_steps(const FarmFilm& film, FarmPlan& plan) {
  std::error_code problem;
  if (!film.bake || fs::exists(film.bake->trajectory, problem)) {
    return;
  }
  FarmStep bake = {"bake", "baking parts of the camera path", film.bake->words, "--part", {}};
  for (int part = 1; part <= film.bake->parts; ++part) {
    bake.tasks.push_back(fmt::format("{}/{}", part, film.bake->parts));
  }
  plan.steps.push_back(std::move(bake));
  plan.steps.push_back({"join", "joining the parts of the bake", film.bake->words, "", {"all"}});
}

//! Adds a step whose tasks are chunks of frames, unless there are no frames.
void add_frame_step(FarmStep step, const std::vector<FrameChunk>& chunks, FarmPlan& plan) {
  for (const FrameChunk& chunk : chunks) {
    step.tasks.push_back(text_of(chunk));
  }
  if (!step.tasks.empty()) {
    plan.steps.push_back(std::move(step));
  }
}

//! Returns the last step: verifies all frames, writes their summary, and encodes the film.
FarmStep film_step(const FarmFilm& film) {
  FarmStep step = {"film", "verifying the frames", render_words(film, {}), "", {"all"}};
  const std::vector<std::string> light = light_words(film);
  step.words.insert(step.words.end(), light.begin(), light.end());
  step.words.insert(step.words.end(), {"--frames=" + text_of(film.frames), "--verify"});
  if (!film.options.movie.empty()) {
    step.description = "verifying the frames and encoding the film";
    step.words.push_back("--movie=" + film.options.movie);
  }
  return step;
}

//! Returns the start of the tasks' shell commands.
std::string program_words(const FarmOptions& options) {
  std::error_code problem;
  const fs::path self = fs::read_symlink("/proc/self/exe", problem);
  const std::string program = !options.program.empty()    ? options.program
                              : options.container.empty() ? self.string()
                                                          : "ergodome";
  return (options.container.empty() ? "" : options.container + " ") + shell_word(program);
}

}  // namespace

FarmPlan farm_plan(const FarmOptions& options, const FarmFilm& film) {
  FarmPlan plan;
  plan.name = film.show.name;
  plan.out = film.options.out;
  plan.work_folder = fs::current_path();
  plan.program = program_words(options);
  plan.film = film.frames;
  plan.chunk = options.engine == "openjd" ? std::min(film.chunk, max_openjd_chunk) : film.chunk;
  const auto chunks = [&](const std::vector<int>& frames) {
    return options.engine == "openjd" ? runs_of(plan.chunk, frames) : chunks_of(film.frames, plan.chunk, frames);
  };
  add_bake_steps(film, plan);
  add_frame_step({"light",
                  "measuring light for automatic exposure",
                  render_words(film, {"--meter=" + FarmFolder(film.options.out).light().string()}),
                  "--frames",
                  {}},
                 chunks(frames_to_meter(film)), plan);
  FarmStep render = {"render", "rendering frames", render_words(film, {"--resume", "--no-summary"}), "--frames", {}};
  const std::vector<std::string> light = light_words(film);
  render.words.insert(render.words.end(), light.begin(), light.end());
  add_frame_step(std::move(render), chunks(frames_to_render(film)), plan);
  plan.steps.push_back(film_step(film));
  return plan;
}

}  // namespace ergodome
