#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "content/show/show.h"
#include "kernels/core/error.h"

// The files that a show names, and their errors.
namespace ergodome {

//! Returns where a show sets a key: "evening.toml:12" or "--set"; "evening.toml" if it does not.
std::string place_of(const Show& show, const std::string& key);

//! Returns the error of a file that `show` names under `key` ("sky.stars", "shells[1].texture"),
//! with the key, the show and the line added to its problem.
Error named_by(const Show& show, const std::string& key, const Error& error);

//! Throws Error if `path` exists and is not a regular file: opening a pipe would block forever.
void require_no_pipe(const std::filesystem::path& path);

//! Returns the result of `read(path)` for the file `name` in the show's folder. Adds key and show
//! to errors as named_by() does.
template <class Read>
auto read_named(const Show& show, const std::string& key, const std::string& name, const Read& read) {
  try {
    const std::filesystem::path path = std::filesystem::path(show.folder) / name;
    require_no_pipe(path);
    return read(path);
  } catch (const Error& error) {
    throw named_by(show, key, error);
  }
}

//! A file that a show names for rendering.
struct NamedFile {
  std::string key;      //!< "shells[1].texture"
  std::string name;     //!< relative to the show's folder, as written
  std::string layer{};  //!< of an image; empty if the show does not select one
};

//! Returns the files of sky, stars, spikes, shells and objects that a show names, in this order,
//! without built-in ones.
std::vector<NamedFile> files_of_pictures(const Show& show);

//! Returns these files, then those of overlays and sound: all that a show names.
std::vector<NamedFile> files_of_show(const Show& show);

//! Returns true if a file that a show names exists.
bool is_there(const Show& show, const std::string& name);

//! Returns true if the name is that of an existing folder.
bool is_folder(const Show& show, const std::string& name);

}  // namespace ergodome
