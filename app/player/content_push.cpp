#include "app/player/content_push.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <random>
#include <set>
#include <system_error>

#include "app/cluster/cluster_codec.h"
#include "app/playback/show_reload.h"
#include "content/files/atomic_file.h"
#include "content/files/fingerprint.h"
#include "content/show/reading/show_files.h"
#include "content/show/reading/show_reader.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace fs = std::filesystem;

namespace {

//! Bytes that a node asks for before they arrive.
constexpr std::uint64_t content_window = 16 * max_cluster_chunk;
//! Time without bytes after which a node asks again [s].
constexpr double ask_for_bytes_again_s = 1.0;

//! Returns the number of folders by which a name leaves its folder.
int levels_up(const fs::path& name) {
  int depth = 0;
  int highest = 0;
  for (const fs::path& part : name.lexically_normal()) {
    depth += part == ".." ? -1 : 1;
    highest = std::min(highest, depth);
  }
  return -highest;
}

bool stays_inside(const fs::path& name) {
  return !name.empty() && name.is_relative() && levels_up(name) == 0 && name.lexically_normal() == name;
}

bool is_whole(const fs::path& path, const ClusterOffer::File& file) {
  std::error_code problem;
  return fs::file_size(path, problem) == file.bytes && !problem;
}

std::string key_of_text(const std::string& text) { return "0-" + fingerprint(text); }

}  // namespace

std::string content_key(const fs::path& file) {
  std::error_code problem;
  const std::uintmax_t bytes = fs::file_size(file, problem);
  const bool large = !problem && bytes > max_hashed_bytes;
  const std::string print = large ? fingerprint_of_start(file, max_hashed_bytes) : fingerprint_of_file(file);
  return print.empty() ? print : fmt::format("{}-{}", large ? bytes : 0, print);
}

ContentSource::ContentSource(const std::vector<Show>& shows) {
  for (const Show& show : shows) {
    const std::vector<NamedFile> named = files_of_show(show);
    int levels = 0;
    for (const NamedFile& file : named) {
      if (fs::path(file.name).is_absolute()) {
        throw Error(file_of(show).string(), fmt::format("names {} by an absolute path", file.name),
                    "write it relative to the show, or copy it to the nodes and leave out --push-content");
      }
      levels = std::max(levels, levels_up(file.name));
    }
    // The show lies as deep as its names lead upwards.
    fs::path folder = std::to_string(offer_.shows.size());
    for (int i = 0; i < levels; ++i) {
      folder /= "x";
    }
    const std::string text = to_toml(show);
    offer_.shows.push_back(static_cast<std::uint16_t>(offer_.files.size()));
    offer_.files.push_back({(folder / "show.toml").string(), key_of_text(text), text.size()});
    texts_[key_of_text(text)] = text;
    for (const NamedFile& file : named) {
      add(fs::path(show.folder) / file.name, (folder / file.name).lexically_normal().string());
    }
    const fs::path trajectory = fs::path(show.folder) / (show.name + ".trajectory");
    if (std::error_code problem; fs::exists(trajectory, problem)) {
      add(trajectory, (folder / "show.trajectory").string());
    }
  }
  if (offer_.files.size() > max_cluster_files) {
    throw Error("--push-content",
                fmt::format("the shows have {} files, more than {}", offer_.files.size(), max_cluster_files),
                "copy them to the nodes, and leave out --push-content");
  }
}

void ContentSource::add(const fs::path& file, const std::string& name) {
  const std::string key = content_key(file);
  std::error_code problem;
  const std::uintmax_t bytes = fs::file_size(file, problem);
  if (key.empty() || problem) {
    throw Error(file.string(), "cannot be read", "correct its permissions, or the show");
  }
  if (std::ranges::none_of(offer_.files, [&](const ClusterOffer::File& each) { return each.name == name; })) {
    offer_.files.push_back({name, key, bytes});
    files_[key] = file;
  }
}

std::optional<ClusterChunk> ContentSource::read(const ClusterWanted& wanted) const {
  ClusterChunk chunk{wanted.key, wanted.offset, {}};
  if (const auto text = texts_.find(wanted.key); text != texts_.end()) {
    if (wanted.offset < text->second.size()) {
      chunk.bytes = text->second.substr(wanted.offset, max_cluster_chunk);
    }
  } else if (const auto found = files_.find(wanted.key); found != files_.end()) {
    std::ifstream file(found->second, std::ios::binary);
    file.seekg(static_cast<std::streamoff>(wanted.offset));
    chunk.bytes.resize(max_cluster_chunk);
    file.read(chunk.bytes.data(), static_cast<std::streamsize>(chunk.bytes.size()));
    chunk.bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  }
  return chunk.bytes.empty() ? std::nullopt : std::optional(std::move(chunk));
}

ContentCache::ContentCache(fs::path folder, ClusterOffer offer)
    : folder_(std::move(folder)), offer_(std::move(offer)), number_(std::random_device()()) {
  make_folder(folder_);
  std::set<std::string> keys;
  for (const ClusterOffer::File& file : offer_.files) {
    if (!stays_inside(file.name)) {
      throw Error(file.name, "is offered by the master outside the folder of its show",
                  "install the same version on both");
    }
    if (keys.insert(file.key).second && !is_whole(folder_ / file.key, file)) {
      missing_.push_back(file);
    }
  }
  begin_file();
}

fs::path ContentCache::partial() const {
  return folder_ / fmt::format("{}.partial-{:x}", missing_.front().key, number_);
}

void ContentCache::begin_file() {
  received_ = asked_ = 0;
  if (!missing_.empty()) {
    // An empty file has no bytes that could arrive.
    std::ofstream(partial(), std::ios::binary | std::ios::trunc).flush();
    if (missing_.front().bytes == 0) {
      end_file();
    }
  }
}

void ContentCache::end_file() {
  const fs::path file = partial();
  const ClusterOffer::File& offered = missing_.front();
  if (content_key(file) != offered.key) {
    throw Error(offered.name, "was damaged on its way, or changed on the master", "start the node again");
  }
  std::error_code problem;
  fs::rename(file, folder_ / offered.key, problem);
  if (problem) {
    throw Error((folder_ / offered.key).string(), "cannot be written: " + problem.message(), "correct its permissions");
  }
  missing_.pop_front();
  begin_file();
}

void ContentCache::take(const ClusterChunk& chunk) {
  if (missing_.empty() || chunk.key != missing_.front().key || chunk.offset != received_) {
    return;
  }
  std::ofstream file(partial(), std::ios::binary | std::ios::app);
  file.write(chunk.bytes.data(), static_cast<std::streamsize>(chunk.bytes.size()));
  file.flush();
  if (!file) {
    throw Error(partial().string(), "cannot be written", "free space on this disk");
  }
  heard_ = true;
  received_ += chunk.bytes.size();
  if (received_ >= missing_.front().bytes) {
    end_file();
  }
}

std::optional<ClusterWanted> ContentCache::next(double now_s) {
  if (missing_.empty()) {
    return std::nullopt;
  }
  if (std::exchange(heard_, false)) {
    heard_s_ = now_s;
  } else if (now_s - heard_s_ > ask_for_bytes_again_s) {
    heard_s_ = now_s;
    asked_ = received_;
  }
  if (asked_ >= missing_.front().bytes || asked_ >= received_ + content_window) {
    return std::nullopt;
  }
  ClusterWanted wanted{missing_.front().key, asked_};
  asked_ += max_cluster_chunk;
  return wanted;
}

std::uint64_t ContentCache::missing_bytes() const {
  std::uint64_t bytes = 0;
  for (const ClusterOffer::File& file : missing_) {
    bytes += file.bytes;
  }
  return bytes - std::min(bytes, received_);
}

std::vector<fs::path> ContentCache::arrange() const {
  const std::vector<std::byte> whole = encode_cluster(offer_);
  const fs::path place = folder_ / ("show-" + fingerprint({reinterpret_cast<const char*>(whole.data()), whole.size()}));
  for (const ClusterOffer::File& file : offer_.files) {
    const fs::path path = place / file.name;
    make_folder(path.parent_path());
    if (is_whole(path, file)) {
      continue;
    }
    std::error_code problem;
    fs::create_hard_link(folder_ / file.key, path, problem);
    if (problem) {
      fs::copy_file(folder_ / file.key, path, fs::copy_options::overwrite_existing, problem);
    }
    // Another node that keeps its files in the same folder may have been faster.
    if (problem && !is_whole(path, file)) {
      throw Error(path.string(), "cannot be written: " + problem.message(), "free space on this disk");
    }
  }
  std::vector<fs::path> shows;
  shows.reserve(offer_.shows.size());
  for (const std::uint16_t show : offer_.shows) {
    shows.push_back(place / offer_.files.at(show).name);
  }
  return shows;
}

fs::path content_cache_folder() {
  if (const char* const cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0') {
    return fs::path(cache) / "ergodome" / "cluster";
  }
  const char* const home = std::getenv("HOME");
  return home != nullptr && *home != '\0' ? fs::path(home) / ".cache" / "ergodome" / "cluster" : fs::path();
}

}  // namespace ergodome
