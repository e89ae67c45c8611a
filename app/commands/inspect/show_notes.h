#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/inspect/mesh_facts.h"
#include "content/show/show.h"
#include "content/stars/star_catalogue.h"

namespace ergodome {

//! Findings of `inspect` about the files that a show names.
struct ShowNotes {
  //! Why existing files cannot be used, by their key ("sky.map").
  std::map<std::string, std::string> unusable;
  //! Sentences about things that will be invisible (ShowRenderer::notes()).
  std::vector<std::string> unseen;
  //! Sentences about maps with invalid light values (ShowRenderer::notes()).
  std::vector<std::string> repaired;
  std::optional<std::size_t> stars;   //!< number of stars, if the show has a readable catalogue
  std::vector<RowsLeftOut> left_out;  //!< rows left out of the star catalogue
  std::string stars_read_as;          //!< columns read from the star catalogue, if it is a table
  std::vector<MeshFacts> meshes;      //!< meshes of files that could be read
};

//! Reads every existing file that the show names, including textures of meshes, as its frames do. A
//! map of 8192 x 4096 takes about a second.
ShowNotes notes_of_files(const Show& show);

}  // namespace ergodome
