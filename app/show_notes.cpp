#include "app/show_notes.h"

#include <algorithm>

#include "content/show_files.h"
#include "content/stars/star_catalogue.h"
#include "kernels/core/error.h"
#include "render/objects/object_horizon.h"

namespace ergodome {

namespace {

//! Adds what `look` finds, or what is wrong with the files that it reads.
template <class Look>
void add_notes(std::vector<std::string>& notes, const Look& look) {
  try {
    look();
  } catch (const Error& problem) {
    notes.emplace_back(problem.what());
  }
}

}  // namespace

std::vector<std::string> notes_of_files(const Show& show) {
  std::vector<std::string> notes;
  const std::string& stars = show.sky.stars;
  if (!stars.empty() && !is_built_in_catalogue(stars) && is_there(show, stars)) {
    add_notes(notes, [&] {
      if (load_stars(show).stars.empty()) {
        notes.push_back(note_of_no_stars(show));
      }
    });
  }
  const bool meshes_there = std::ranges::all_of(
      show.objects, [&](const ObjectSettings& object) { return object.mesh.empty() || is_there(show, object.mesh); });
  if (!show.objects.empty() && meshes_there) {
    add_notes(notes, [&] {
      for (const ObjectInHorizon& inside : objects_in_horizon(show, load_meshes(show))) {
        notes.push_back(note_of(show, inside));
      }
    });
  }
  return notes;
}

}  // namespace ergodome
