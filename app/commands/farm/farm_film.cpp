#include "app/commands/farm/farm_film.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/cli/show_loading.h"
#include "app/commands/farm/farm_folder.h"
#include "app/commands/farm/frame_chunks.h"
#include "app/commands/farm/frame_timing.h"
#include "app/commands/farm/local_engine.h"
#include "app/commands/render/followed_light.h"
#include "app/commands/render/frame_check.h"
#include "app/commands/render/frame_request.h"
#include "app/commands/render/frame_writer.h"
#include "app/commands/render/render_budget.h"
#include "app/commands/render/render_request.h"
#include "content/files/console.h"
#include "content/files/printable.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

//! Loads the show as `render` does.
void load_film(const FarmOptions& farm, FarmFilm& film) {
  film.show = chosen_show(film.options);
  film.setup = chosen_setup(film.options);
  fit_to_chosen_setup(film.options, film.setup, film.show);
  require_features(film.show);
  const auto [first, last] = chosen_frames(film.options, film.show);
  film.frames = {first, last};
  film.bake = film_bake(farm, film.show, last - first + 1);
  if (film.bake) {
    film.options.lens.trajectory = film.bake->trajectory.string();
  }
  require_used_options(film.options, film.show);
}

//! Checks what frames and film need. With a container, the encoder of the film is in the container.
void prepare_film(const FarmOptions& farm, FarmFilm& film) {
  RenderOptions here = film.options;
  if (!farm.container.empty()) {
    here.movie.clear();
  }
  prepare_frames(here, film.show);
}

//! Returns the options that give frames the settings that --budget chooses here and now.
std::vector<std::string> measured_quality(RenderOptions options, Show show, const std::optional<DomeSetup>& setup) {
  const SkyFilter filter = show.sky.filter;
  static_cast<void>(use_render_budget(options, show, setup));
  std::vector<std::string> words = {fmt::format("--set=quality.budget_px={:.17g}", show.quality.budget_px)};
  if (show.sky.filter != filter) {
    words.push_back(fmt::format("--set=sky.filter=\"{}\"", show.sky.filter == SkyFilter::point ? "point" : "ewa"));
  }
  words.push_back("--lens=" + options.lens.lens);
  return words;
}

//! Replaces --budget by the settings that it chooses.
void fix_quality(const std::vector<std::string>& quality, RenderOptions& options) {
  constexpr std::string_view set = "--set=";
  constexpr std::string_view lens = "--lens=";
  for (const std::string& word : quality) {
    if (word.starts_with(set)) {
      options.set.push_back(word.substr(set.size()));
    } else if (word.starts_with(lens)) {
      options.lens.lens = word.substr(lens.size());
    }
  }
  options.budget.clear();
}

int chosen_chunk(const FarmOptions& options, const FarmFilm& film, const std::optional<FilmChoices>& stored) {
  const int count = film.frames.last - film.frames.first + 1;
  const int least = (count + max_tasks - 1) / max_tasks;
  if (options.chunk > 0) {
    return std::max(options.chunk, least);
  }
  if (stored && stored->chunk > 0) {
    return stored->chunk;
  }
  const FrameTiming timing = time_frames(film.options, film.show, film.frames);
  int chunk = chunk_size(timing.frame_s, timing.start_s, count);
  if (options.engine == "local") {
    const int jobs = options.jobs > 0 ? options.jobs : usual_jobs();
    chunk = std::min(chunk, std::max((count + jobs - 1) / jobs, least));
  }
  print_note("a frame takes about {:.2g} s here; a task renders {}", timing.frame_s, counted(chunk, "frame"));
  return chunk;
}

//! Returns the fingerprint of a frame's request before settings are measured.
std::string film_fingerprint(const FarmFilm& film) {
  return FrameRequests(film.options, film.show, film.setup).at(frame_time_s(film.show, film.frames.first));
}

}  // namespace

FarmFilm farm_film(FarmOptions& options, std::vector<std::string> words) {
  FarmFilm film;
  film.options = options.render;
  load_film(options, film);
  prepare_film(options, film);
  const FarmFolder folder(options.render.out);
  const std::string request = film_fingerprint(film);
  const std::optional<FilmChoices> stored = stored_choices(folder, request);
  FilmChoices choices = {request, 0, {}};
  if (!film.options.budget.empty()) {
    choices.quality = stored ? stored->quality : measured_quality(film.options, film.show, film.setup);
    std::erase_if(words, [](const std::string& word) { return word.starts_with("--lens="); });
    words.insert(words.end(), choices.quality.begin(), choices.quality.end());
    fix_quality(choices.quality, film.options);
    load_film(options, film);
    prepare_film(options, film);
  }
  film.chunk = chosen_chunk(options, film, stored);
  choices.chunk = film.chunk;
  if (!options.dry_run) {
    store_choices(folder, choices);
  }
  if (film.bake) {
    words.push_back("--trajectory=" + film.bake->trajectory.string());
  }
  if (!film.options.language.empty() && frames_show_language(chosen_show(film.options))) {
    words.push_back("--language=" + film.options.language);
  }
  film.words = std::move(words);
  return film;
}

std::vector<int> frames_to_meter(const FarmFilm& film) {
  std::vector<int> frames;
  if (!follows_exposure(film.options, film.show)) {
    return frames;
  }
  frames = all_frames(film.frames);
  std::error_code problem;
  const fs::path folder = FarmFolder(film.options.out).light();
  if (fs::exists(folder, problem)) {
    const FollowedLight light(folder, film.show, FrameRequests(film.options, film.show, film.setup));
    std::erase_if(frames, [&](int frame) { return light.stops_at(frame).has_value(); });
  }
  return frames;
}

std::vector<int> frames_to_render(const FarmFilm& film) {
  std::error_code problem;
  const bool unbaked = film.bake && !fs::exists(film.bake->trajectory, problem);
  if (unbaked || !fs::exists(film.options.out, problem) || !frames_to_meter(film).empty()) {
    return all_frames(film.frames);
  }
  RenderOptions options = film.options;
  if (follows_exposure(options, film.show)) {
    options.light = FarmFolder(options.out).light().string();
  }
  const FrameWriter writer(options, film.show, film.setup, FrameRequests(options, film.show, film.setup));
  return lacking_frames(writer.files(), film.frames.first, film.frames.last);
}

}  // namespace ergodome
