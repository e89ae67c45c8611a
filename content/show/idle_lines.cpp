#include "content/show/idle_lines.h"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

#include "content/show/show_schema.h"

namespace ergodome {

namespace {

constexpr std::string_view animated = "animate.";

class Idle {
 public:
  explicit Idle(const Show& show) : show_(show) {}

  //! Reports these keys, the keys in their tables and the animations of both as unused.
  void add(std::initializer_list<std::string> keys, const std::string& why) {
    for (const auto& [path, line] : show_.lines) {
      std::string_view of = path;
      if (of.starts_with(animated)) {
        of.remove_prefix(animated.size());
      }
      const bool animation = of.size() < path.size();
      if (std::ranges::any_of(keys, [&](std::string_view key) { return is_of(key, of, animation); })) {
        lines_.push_back({path, line, why});
      }
    }
  }

  std::vector<IdleLine> in_order() {
    std::ranges::stable_sort(lines_, {}, &IdleLine::line);
    return lines_;
  }

 private:
  //! Returns true if a path is the key or below it. A key below it is not reported separately if
  //! the table itself has a line in the file.
  [[nodiscard]] bool is_of(std::string_view key, std::string_view path, bool animation) const {
    const bool below = path.starts_with(key) && path.substr(key.size()).starts_with('.');
    return path == key || (below && (animation || !show_.lines.contains(std::string(key))));
  }

  const Show& show_;
  std::vector<IdleLine> lines_;
};

//! Adds the unused keys of a table and of the tables below it.
void add_keys(std::span<const ShowKey> keys, const std::string& path, const Show& show, const void* settings,
              Idle& idle) {
  for (const ShowKey& key : keys) {
    const char* const why = key.unused != nullptr ? key.unused(show, settings) : nullptr;
    if (why != nullptr) {
      idle.add({path + std::string(key.name)}, why);
    }
    for (std::size_t i = 0; !key.keys.empty() && i < std::max<std::size_t>(key.most, 1); ++i) {
      const void* const below = key.at(const_cast<void*>(settings), i);
      if (below == nullptr) {
        break;
      }
      add_keys(key.keys, path_below(path, key, i), show, below, idle);
    }
  }
}

void add_light(const Show& show, Idle& idle) {
  if (!show.light) {
    return;
  }
  if (std::ranges::none_of(show.objects, &ObjectSettings::lit)) {
    idle.add({"light"}, "is used only by objects with light = \"lambert\"");
  } else if (show.light->falloff == LampFalloff::lens && show.objects.front().method == ObjectMethod::polygon) {
    idle.add({"light.falloff"}, "\"lens\" is used only with method = \"trace\"; polygons use \"published\"");
  }
}

void add_objects(const Show& show, Idle& idle) {
  for (std::size_t i = 0; i < show.objects.size(); ++i) {
    const std::string of = "objects[" + std::to_string(i) + "].";
    if (!show.objects[i].orbit) {
      idle.add({of + "retarded"}, "is used only by objects on an orbit");
    }
    if (show.objects[i].method != ObjectMethod::polygon) {
      // Diagrams of traced objects use `torn`, which is in the same table.
      if (show.objects[i].torn == ObjectSettings().torn) {
        idle.add({of + "tessellation"}, "is used only with method = \"polygon\"");
      }
    }
  }
}

}  // namespace

std::vector<IdleLine> idle_lines(const Show& show) {
  Idle idle(show);
  add_keys(show_keys(), "", show, &show, idle);
  add_light(show, idle);
  add_objects(show, idle);
  return idle.in_order();
}

}  // namespace ergodome
