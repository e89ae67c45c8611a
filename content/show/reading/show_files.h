#pragma once

#include <string>
#include <vector>

#include "content/show/show.h"

namespace ergodome {

//! A file that a show names for rendering.
struct NamedFile {
  std::string key;      //!< "shells[1].texture"
  std::string name;     //!< name as written in the show, relative to the show's folder
  std::string layer{};  //!< selected layer of an image; empty if the show does not select one
};

//! Returns the files of sky, stars, spikes, shells and objects that a show names, in this order,
//! without built-in ones.
std::vector<NamedFile> files_of_pictures(const Show& show);

//! Returns all files that a show names: those of files_of_pictures(), then those of overlays and
//! sound.
std::vector<NamedFile> files_of_show(const Show& show);

//! Returns true if a file that a show names exists.
bool is_there(const Show& show, const std::string& name);

//! Returns true if the name is that of an existing folder.
bool is_folder(const Show& show, const std::string& name);

}  // namespace ergodome
