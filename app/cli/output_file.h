#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>

namespace ergodome {

//! Checks a file that a command is to write before it does any work. `option` names it in messages ("--out"). Throws Error where it is one of the files that
//! the command reads, under whatever name: that would be lost. Nothing is wrong with names that are empty.
void require_other_file(const std::string& option, const std::filesystem::path& written,
                        std::initializer_list<std::filesystem::path> read);

//! The same for a file whose folder is to be there: throws where it is not. Folders are made where an option names one alone.
void require_output_file(const std::string& option, const std::filesystem::path& written,
                         std::initializer_list<std::filesystem::path> read);

//! The same for a PNG; throws where the name does not end like one.
void require_other_png(const std::string& option, const std::filesystem::path& written,
                       std::initializer_list<std::filesystem::path> read);

}  // namespace ergodome
