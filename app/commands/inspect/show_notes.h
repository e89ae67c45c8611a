#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "content/mesh/triangle_mesh.h"
#include "content/show/show.h"
#include "content/stars/star_catalogue.h"

namespace ergodome {

//! A summary of a mesh file, in the file's units.
struct MeshSummary {
  std::string file;  //!< file name as given in the show
  long triangles = 0;
  long dropped_triangles = 0;
  Vector3<double> extent;  //!< size along the mesh's axes
  std::vector<std::string> remarks;
};

//! Summarizes a mesh. Reads the textures whose alpha channel is used, to remark on transparent
//! ones. Throws Error if one cannot be read.
MeshSummary summary_of_mesh(const std::string& file, const TriangleMesh& mesh);

//! Returns a list of the show's objects that are meshes with a summary in `meshes`. Extents are
//! scaled to M by the object's size.
nlohmann::json summary_of_meshes(const Show& show, const std::vector<MeshSummary>& meshes);

void print_meshes(const nlohmann::json& summary);

//! Findings of `inspect` about the files that a show names, and about what its pictures cannot
//! show.
struct ShowNotes {
  //! Why existing files cannot be used, by their key ("sky.map").
  std::map<std::string, std::string> unusable;
  //! Sentences about things that will be invisible (ShowRenderer::notes()), and about eyes whose
  //! pictures differ too much.
  std::vector<std::string> unseen;
  //! Sentences about maps with invalid light values (ShowRenderer::notes()).
  std::vector<std::string> repaired;
  std::optional<std::size_t> stars;   //!< number of stars, if the show has a readable catalogue
  std::vector<RowsLeftOut> left_out;  //!< rows left out of the star catalogue
  std::string stars_read_as;          //!< columns read from the star catalogue, if it is a table
  std::vector<MeshSummary> meshes;    //!< meshes of files that could be read
};

//! Reads every existing file that the show names, including textures of meshes, as its frames do,
//! and checks objects, captions and the eyes' convergence. A map of 8192 x 4096 takes about a
//! second.
ShowNotes notes_of_files(const Show& show);

//! Returns the number of stars in a show's catalogue, the columns read, and how many rows were left
//! out and why, as notes_of_files() found them.
nlohmann::json summary_of_stars(const Show& show, const ShowNotes& notes);

void print_stars(const nlohmann::json& summary);

}  // namespace ergodome
