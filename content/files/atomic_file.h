#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>

namespace ergodome {

//! Writes a file completely or not at all. `write` fills an empty file next to it
//! (.partial-RANDOM-NAME), which is then flushed to the disk and renamed. `write` must not replace
//! that file by another one. A symbolic link stays, and its target is written. If anything fails (a
//! full disk, a folder without permission, an exception of `write`), removes the partial file,
//! leaves an older file unchanged, and throws Error or the exception of `write`. Throws Error if
//! the name is that of a device, a pipe or a folder.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& partial)>& write);

//! Returns the path that write_atomically() writes for a name: the target of a symbolic link,
//! otherwise the name itself. Throws Error for a circular link.
std::filesystem::path behind_links(const std::filesystem::path& path);

//! Checks that write_atomically() and keep_older() can write a file with this name, so that no work
//! is lost: if the file exists, it must be a regular file; its folder must be writable, or it must
//! be possible to create it. Changes nothing. Throws Error if they cannot. Does not detect a full
//! disk.
void require_writable(const std::filesystem::path& path);

//! Removes the partial files of interrupted programs from a folder. Keeps files that a program
//! still writes, on any machine or in any container, and all files on a file system without locks.
void remove_abandoned_files(const std::filesystem::path& folder);

//! Returns true if fewer than 64 KiB are free on a file's disk. Libraries do not distinguish this
//! from other reasons for failed writing.
bool disk_is_full(const std::filesystem::path& file);

//! Writes text as write_atomically() does.
void write_text_atomically(const std::filesystem::path& path, std::string_view text);

//! Copies an existing file to NAME.bak, replacing an older copy. Throws Error if that fails.
void keep_older(const std::filesystem::path& path);

//! Writes text, and keeps the previous file as NAME.bak. Changes neither if the file already
//! contains the text.
void write_text_keeping_older(const std::filesystem::path& path, std::string_view text);

//! Creates a folder and its parents if they do not exist. Throws Error if that fails.
void make_folder(const std::filesystem::path& folder);

//! Writes all bytes to an open file or pipe. Returns false, with errno set, on failure.
bool write_all(int handle, const char* bytes, std::size_t count);

}  // namespace ergodome
