#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "content/show/show.h"
#include "kernels/core/error.h"

// Files that a show names.
namespace ergodome {

//! Returns where a show gives a key: "evening.toml:12", or "--set"; "evening.toml" where it does not.
std::string place_of(const Show& show, const std::string& key);

//! `error` of a file that `show` names under `key` ("sky.stars", "shells[1].texture"): says in its problem under which key, of which show,
//! and at which line where that came from a file.
Error named_by(const Show& show, const std::string& key, const Error& error);

//! Throws Error where something is at `path` that is no regular file: to open a pipe would wait for ever.
void require_no_pipe(const std::filesystem::path& path);

//! Returns what `read(path)` makes of the file `name` in the show's folder. named_by() completes its errors.
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

//! A file that a show names for its pictures.
struct NamedFile {
  std::string key;      //!< "shells[1].texture"
  std::string name;     //!< as the show gives it, from its folder
  std::string layer{};  //!< of an image, if the show selects one
};

//! The files of sky, stars, spikes, shells and objects that a show names, in this order; what is built in is none.
std::vector<NamedFile> files_of_pictures(const Show& show);

//! These, and after them those of overlays and sound: all that a show names.
std::vector<NamedFile> files_of_show(const Show& show);

//! Whether a file that a show names is there.
bool is_there(const Show& show, const std::string& name);

//! Whether a folder is there in its place.
bool is_folder(const Show& show, const std::string& name);

}  // namespace ergodome
