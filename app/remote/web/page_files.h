#pragma once

#include <span>
#include <string_view>

namespace ergodome {

//! A file of the status page from the folder page/, embedded when the program was built.
struct PageFile {
  std::string_view name;  //!< "page.js"
  std::string_view bytes;
};

//! Returns all files of the status page.
std::span<const PageFile> page_files();

}  // namespace ergodome
