#include "app/commands/inspect/show_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "app/playback/sound/audio_file.h"
#include "content/mesh/mesh_reader.h"
#include "content/show/animated_show.h"
#include "content/show/show_files.h"
#include "content/sky/environment_image.h"
#include "content/stars/star_catalogue.h"
#include "kernels/core/angles.h"
#include "kernels/core/error.h"
#include "render/passes/effects/diffraction.h"
#include "render/passes/objects/object_horizon.h"
#include "render/passes/objects/object_meshes.h"
#include "render/passes/overlay/caption_notes.h"
#include "render/passes/overlay/overlay_image.h"

namespace ergodome {

namespace {

namespace fs = std::filesystem;

void take_stars(const Show& show, ShowNotes& notes) {
  const StarCatalogue catalogue = load_stars(show);
  notes.stars = catalogue.stars.size();
  notes.left_out = catalogue.left_out;
  notes.stars_read_as = catalogue.read_as;
  if (catalogue.stars.empty()) {
    notes.unseen.push_back(note_of_no_stars(show));
  }
}

//! Reads a file as the show's frames need it, by the kind of its key. Throws Error if it cannot be
//! used.
void read_as_shown(const Show& show, const NamedFile& file, ShowNotes& notes) {
  if (file.key == "sky.stars") {
    take_stars(show, notes);
    return;
  }
  read_named(show, file.key, file.name, [&](const fs::path& path) {
    if (file.key == "sky.map" || file.key.ends_with(".texture")) {
      const RepairedTexels repaired =
          read_environment_image(path.string() + (file.layer.empty() ? "" : "#" + file.layer)).repaired;
      if (repaired.are_a_mistake()) {
        notes.repaired.push_back(note_of_repair(show, file.key, file.name, repaired));
      }
    } else if (file.key.ends_with(".pattern")) {
      static_cast<void>(load_diffraction_pattern(path));
    } else if (file.key.ends_with(".mesh")) {
      notes.meshes.push_back(facts_of_mesh(file.name, read_mesh(path)));
    } else if (file.key.ends_with(".image")) {
      static_cast<void>(read_overlay_image(path));
    }
    return 0;
  });
}

//! Returns why a file cannot be used; empty if it can.
std::string problem_of(const Show& show, const NamedFile& file, ShowNotes& notes) {
  if (file.key.starts_with("audio")) {
    return sound_problem(fs::path(show.folder) / file.name);
  }
  try {
    read_as_shown(show, file, notes);
  } catch (const Error& problem) {
    return problem.what();
  }
  return "";
}

//! Adds notes about objects inside the horizon, if all meshes could be read.
void add_objects_in_horizon(const Show& show, ShowNotes& notes) {
  const bool readable = std::ranges::all_of(
      show.objects, [&](const ObjectSettings& object) { return object.mesh.empty() || is_there(show, object.mesh); });
  const bool sound =
      std::ranges::none_of(notes.unusable, [](const auto& each) { return each.first.ends_with(".mesh"); });
  if (show.objects.empty() || !readable || !sound) {
    return;
  }
  try {
    for (const ObjectInHorizon& inside : objects_in_horizon(show, load_meshes(show))) {
      notes.unseen.push_back(note_of(show, inside));
    }
  } catch (const Error& problem) {
    notes.unseen.emplace_back(problem.what());
  }
}

//! Adds a note for the first sampled time at which the convergence distance is smaller than the
//! baseline.
void add_crossed_eyes(const Show& show, ShowNotes& notes) {
  constexpr int times = 33;
  for (int i = 0; i < times && eye_count(show.stereo) > 1; ++i) {
    const double time_s = show.duration_s * i / (times - 1);
    const StereoSettings stereo = show_at(show, time_s).stereo;
    if (stereo.convergence > 0.0 && stereo.convergence < stereo.baseline) {
      const Error note("stereo.convergence",
                       fmt::format("at {:.6g} s the baseline is {:.4g} M but the convergence distance only {:.4g} M, "
                                   "so the eyes' images differ by {:.0f} degrees",
                                   time_s, stereo.baseline, stereo.convergence,
                                   2.0 * std::atan2(0.5 * stereo.baseline, stereo.convergence) / one_degree),
                       "set a convergence distance of at least a few baselines");
      notes.unseen.emplace_back(
          show.lines.contains("stereo.convergence") ? named_by(show, "stereo.convergence", note).what() : note.what());
      return;
    }
  }
}

}  // namespace

ShowNotes notes_of_files(const Show& show) {
  ShowNotes notes;
  if (is_built_in_catalogue(show.sky.stars)) {
    try {
      take_stars(show, notes);
    } catch (const Error& problem) {
      notes.unusable["sky.stars"] = problem.what();
    }
  }
  // A file that is used several times is read once.
  std::map<std::string, std::string> known;
  for (const NamedFile& file : files_of_show(show)) {
    if (!is_there(show, file.name)) {
      continue;
    }
    const std::string use = file.key.substr(file.key.rfind('.')) + " " + file.name;
    const auto found = known.find(use);
    const std::string problem = found != known.end() ? found->second : problem_of(show, file, notes);
    known[use] = problem;
    if (!problem.empty()) {
      notes.unusable[file.key] = problem;
    }
  }
  add_objects_in_horizon(show, notes);
  std::ranges::copy(notes_of_captions(show), std::back_inserter(notes.unseen));
  add_crossed_eyes(show, notes);
  return notes;
}

}  // namespace ergodome
