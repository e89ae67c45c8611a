#pragma once

#include <filesystem>
#include <functional>

namespace ergodome {

//! Writes a file whole or not at all: `write` fills an empty file beside it (.partial-RANDOM-NAME), which is then flushed to
//! the disk and renamed. `write` must not replace that file by another one. A link stays, and the file that it names is
//! written. When anything fails (a full disk, a folder without permission, an exception of `write`) the partial file is
//! removed, an older file of that name stays as it was, and Error says what happened. Throws Error where the name is that of
//! a device, a pipe or a folder.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& partial)>& write);

//! Where write_atomically() puts a file of a name: behind a link, else there.
std::filesystem::path behind_links(const std::filesystem::path& path);

//! Looks whether write_atomically() can write a file of that name, and keep_older() one that is there, before any work is done for it: what is there is a
//! file, and its folder takes new ones, or can be made where it is not there. Changes nothing. Throws Error where that is not so; a disk that is full is
//! seen by writing alone.
void require_writable(const std::filesystem::path& path);

//! Removes the partial files that killed programs have left in a folder. Files that a program still writes stay, whatever
//! machine or container it runs in, and so do all files where the file system has no locks.
void remove_abandoned_files(const std::filesystem::path& folder);

//! Whether a file's disk has next to nothing left, which libraries do not tell from other reasons why they cannot write.
bool disk_is_full(const std::filesystem::path& file);

//! write_atomically() for text.
void write_text_atomically(const std::filesystem::path& path, std::string_view text);

//! Copies a file that is there to NAME.bak, in place of an older one of that name. Throws Error where that cannot be.
void keep_older(const std::filesystem::path& path);

//! Writes text, and keeps what a file of that name held before as NAME.bak. A file that holds the same already stays, as does its .bak.
void write_text_keeping_older(const std::filesystem::path& path, std::string_view text);

//! Makes a folder, with those above it, where there is none. Throws Error where that cannot be.
void make_folder(const std::filesystem::path& folder);

}  // namespace ergodome
