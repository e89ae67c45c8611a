#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/cluster/cluster_messages.h"
#include "content/show/show.h"

namespace ergodome {

//! Returns what distinguishes the content of a file from that of others, as a file name. Of a file
//! above a gibibyte, only the first one and the size count. Returns an empty text if the file cannot
//! be read.
std::string content_key(const std::filesystem::path& file);

//! The files of the master's shows, from which nodes get those that they lack (--push-content).
class ContentSource {
 public:
  //! Throws Error if a show names a file by an absolute path, which may mean another file elsewhere,
  //! or if a file cannot be read.
  explicit ContentSource(const std::vector<Show>& shows);

  [[nodiscard]] const ClusterOffer& offer() const { return offer_; }
  //! Returns the bytes of a file from an offset on, at most max_cluster_chunk. Returns nothing
  //! at its end, or if the file is not offered.
  [[nodiscard]] std::optional<ClusterChunk> read(const ClusterWanted& wanted) const;

 private:
  void add(const std::filesystem::path& file, const std::string& name);

  ClusterOffer offer_;
  std::map<std::string, std::filesystem::path> files_;  //!< by their keys
  std::map<std::string, std::string> texts_;            //!< contents that are not files, by their keys
};

//! Files that a node gets from the master, in a folder that it keeps.
class ContentCache {
 public:
  //! Throws Error if the offer names a file outside the folder of its show.
  ContentCache(std::filesystem::path folder, ClusterOffer offer);

  //! Takes bytes of a file. Throws Error if they cannot be written, or if a complete file is not
  //! that of the offer.
  void take(const ClusterChunk& chunk);
  //! Returns what to ask the master for now; nothing if enough was asked for. `now_s`: time of a
  //! steady clock.
  [[nodiscard]] std::optional<ClusterWanted> next(double now_s);
  //! Returns whether all files are there.
  [[nodiscard]] bool complete() const { return missing_.empty(); }
  //! Arranges the files as their names say, and returns the files of the shows. Throws Error if that
  //! fails.
  [[nodiscard]] std::vector<std::filesystem::path> arrange() const;

  [[nodiscard]] std::uint64_t missing_bytes() const;

 private:
  void begin_file();
  void end_file();
  [[nodiscard]] std::filesystem::path partial() const;

  std::filesystem::path folder_;
  ClusterOffer offer_;
  //! Distinguishes the files that this node is receiving from those of nodes with the same folder.
  std::uint32_t number_;
  std::deque<ClusterOffer::File> missing_;  //!< the first one is being received
  std::uint64_t received_ = 0;              //!< bytes of the first one
  std::uint64_t asked_ = 0;                 //!< bytes that were asked for
  double heard_s_ = -1e9;                   //!< when bytes came, or were asked for again
  bool heard_ = true;
};

//! Returns the folder in which this user's nodes keep files of masters. Empty if the user has no home
//! folder.
std::filesystem::path content_cache_folder();

}  // namespace ergodome
