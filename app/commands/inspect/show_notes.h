#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/inspect/mesh_facts.h"
#include "content/show/show.h"
#include "content/stars/star_catalogue.h"

namespace ergodome {

//! What is to be known of the files that a show names before it is shown.
struct ShowNotes {
  std::map<std::string, std::string>
      unusable;  //!< why files cannot be used that are there, as who shows it would be told; by their key ("sky.map")
  std::vector<std::string> unseen;    //!< sentences about what nobody will see (ShowRenderer::notes())
  std::vector<std::string> repaired;  //!< sentences about maps with what is no light (the same)
  std::optional<std::size_t> stars;   //!< how many there are, if there is a catalogue that can be read
  std::vector<RowsLeftOut> left_out;  //!< of their catalogue
  std::string stars_read_as;          //!< which columns of their catalogue were read, if it is a table
  std::vector<MeshFacts> meshes;      //!< of files that could be read
};

//! Reads every file that the show names and that is there, pictures on meshes too, as they are read for its frames: a map of 8192 x 4096 takes about a second.
ShowNotes notes_of_files(const Show& show);

}  // namespace ergodome
