#include "app/cluster/cluster_keys.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "content/files/toml_table.h"
#include "content/files/whole_file.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

constexpr const char* key_remedy = "make a new one with ergodome node --make-key FILE, and copy it to every computer";

std::string read_curve_key(TomlTable& table, std::string_view name) {
  constexpr std::size_t length = 40;
  constexpr std::string_view symbols = ".-:+=^!/*?&<>()[]{}@%$#";
  std::string key = table.text(name, "");
  const auto valid = [&](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           symbols.find(c) != std::string_view::npos;
  };
  if (key.size() != length || !std::ranges::all_of(key, valid)) {
    throw table.error_at(name, "is missing or is not a key", key_remedy);
  }
  return key;
}

}  // namespace

ClusterKeys read_cluster_keys(const std::filesystem::path& file) {
  constexpr std::size_t largest = std::size_t{1} << 16U;
  const std::string text = read_whole_file(file, largest, key_remedy);
  struct stat state {};
  if (stat(file.c_str(), &state) == 0 && (state.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    throw Error(file.string(), "can be read by other users, who could join the cluster",
                fmt::format("run chmod 600 {}", file.string()));
  }
  const toml::table parsed = parse_toml(text, file.string(), 1, "a file of keys");
  TomlTable table(parsed, file.string(), "");
  ClusterKeys keys;
  keys.master_public = read_curve_key(table, "master_public");
  keys.master_secret = read_curve_key(table, "master_secret");
  keys.node_public = read_curve_key(table, "node_public");
  keys.node_secret = read_curve_key(table, "node_secret");
  table.refuse_unknown_keys();
  return keys;
}

void write_cluster_keys(const std::filesystem::path& file, const ClusterKeys& keys) {
  const std::string text = fmt::format(
      "# Keys of a dome of several computers. Whoever has this file can join and control the dome: keep it secret.\n"
      "# Every computer of the dome needs the same file.\n"
      "master_public = \"{}\"\nmaster_secret = \"{}\"\nnode_public = \"{}\"\nnode_secret = \"{}\"\n",
      keys.master_public, keys.master_secret, keys.node_public, keys.node_secret);
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (descriptor < 0 && errno == EEXIST) {
    throw Error(file.string(), "exists, and its keys may be in use", "choose another name, or delete the file first");
  }
  const bool written =
      descriptor >= 0 && write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const std::string reason = std::strerror(errno);
  if (descriptor >= 0 && close(descriptor) == 0 && written) {
    return;
  }
  throw Error(file.string(), "cannot be written: " + reason, "choose a folder that exists and is writable");
}

}  // namespace ergodome
