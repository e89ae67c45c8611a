#include "content/show/unused_keys.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "content/show/show_schema.h"

namespace ergodome {

namespace {

constexpr std::string_view animated = "animate.";

class UnusedKeyFinder {
 public:
  explicit UnusedKeyFinder(const Show& show) : show_(show) {}

  //! Lists a key as unused, and, as further entries of the list, the animations of the key and of
  //! all keys below it. If the key has no line of its own in the file, also lists the keys below
  //! it.
  void add(const std::string& key, const char* why) {
    for (const auto& [path, line] : show_.lines) {
      std::string_view of = path;
      if (of.starts_with(animated)) {
        of.remove_prefix(animated.size());
      }
      const bool animation = of.size() < path.size();
      if (is_of(key, of, animation)) {
        lines_.push_back({path, line, why});
      }
    }
  }

  std::vector<UnusedKey> in_order() {
    std::ranges::stable_sort(lines_, {}, &UnusedKey::line);
    return lines_;
  }

 private:
  //! Returns true if `path` is the key itself or a key below it. If `key` is a table with a line of
  //! its own in the file, keys below it are reported only if they are animated (`animation`).
  [[nodiscard]] bool is_of(std::string_view key, std::string_view path, bool animation) const {
    const bool below = path.starts_with(key) && path.substr(key.size()).starts_with('.');
    return path == key || (below && (animation || !show_.lines.contains(std::string(key))));
  }

  const Show& show_;
  std::vector<UnusedKey> lines_;
};

//! Adds the unused keys of a table and of the tables below it.
void add_keys(std::span<const ShowKey> keys, const std::string& path, const Show& show, const void* settings,
              UnusedKeyFinder& finder) {
  for (const ShowKey& key : keys) {
    const char* const why = key.unused != nullptr ? key.unused(show, settings) : nullptr;
    if (why != nullptr) {
      finder.add(path + std::string(key.name), why);
    }
    for (std::size_t i = 0; !key.keys.empty() && i < std::max<std::size_t>(key.max_tables, 1); ++i) {
      const void* const below = key.at(const_cast<void*>(settings), i);
      if (below == nullptr) {
        break;
      }
      add_keys(key.keys, path_below(path, key, i), show, below, finder);
    }
  }
}

}  // namespace

std::vector<UnusedKey> unused_keys(const Show& show) {
  UnusedKeyFinder finder(show);
  add_keys(show_keys(), "", show, &show, finder);
  return finder.in_order();
}

}  // namespace ergodome
