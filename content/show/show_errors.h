#pragma once

#include <filesystem>
#include <string>

#include "content/show/show.h"
#include "kernels/core/error.h"

namespace ergodome {

//! Returns where a show sets a key: "evening.toml:12" or "--set"; "evening.toml" if it does not.
std::string location_of(const Show& show, const std::string& key);

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

}  // namespace ergodome
