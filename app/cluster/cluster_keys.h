#pragma once

#include <filesystem>
#include <string>

namespace ergodome {

//! The keys by which the computers of a cluster recognize each other (CurveZMQ), as 40 characters
//! each. All computers have the same file.
struct ClusterKeys {
  std::string master_public;
  std::string master_secret;
  std::string node_public;
  std::string node_secret;
};

//! Reads a file of keys. Throws Error if it is missing or malformed, and if other users of this
//! computer can read it.
ClusterKeys read_cluster_keys(const std::filesystem::path& file);

//! Writes keys to a new file that only this user can read. Throws Error if the file exists, because
//! its keys may be in use, or if it cannot be written.
void write_cluster_keys(const std::filesystem::path& file, const ClusterKeys& keys);

}  // namespace ergodome
