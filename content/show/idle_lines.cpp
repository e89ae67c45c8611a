#include "content/show/idle_lines.h"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

#include "content/fall/free_fall.h"
#include "content/show/animated_show.h"
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
    const bool list = key.kind == KeyKind::tables;
    const char* const why = key.unused != nullptr ? key.unused(show, settings) : nullptr;
    if (why != nullptr) {
      idle.add({path + std::string(key.name)}, why);
    }
    for (std::size_t i = 0; !key.keys.empty() && i < std::max<std::size_t>(key.most, 1); ++i) {
      if (const void* const below = key.at(const_cast<void*>(settings), i)) {
        const std::string own = path + std::string(key.name) + (list ? "[" + std::to_string(i) + "]" : "");
        add_keys(key.keys, own + ".", show, below, idle);
      }
    }
  }
}

void add_sky(const Show& show, Idle& idle) {
  if (show.sky.map == "black") {
    idle.add({"sky.filter", "sky.shift", "sky.brightening"}, "has no effect on map = \"black\"");
    if (show.sky.stars.empty()) {
      idle.add({"sky.exposure", "sky.spin_axis"}, "has no effect without stars on map = \"black\"");
    }
  } else if (!show.effects.redshift) {
    idle.add({"sky.shift"}, "is used only with effects.redshift = true");
  }
  if (show.sky.map == "grid") {
    idle.add({"sky.spin_axis"}, "has no effect on map = \"grid\", which uses the hole's own axes");
  }
  if (show.sky.stars.empty()) {
    idle.add({"stars.method", "sky.faintest_mag"}, "has no effect without sky.stars");
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

void add_shells(const Show& show, Idle& idle) {
  for (std::size_t i = 0; i < show.shells.size(); ++i) {
    const ShellSettings& shell = show.shells[i];
    const std::string of = "shells[" + std::to_string(i) + "].";
    const auto never = [&](const char* key, double value) {
      return value <= 0.0 && find_animation(show, of + key) == nullptr;
    };
    if (never("line_width_deg", shell.line_width_deg)) {
      idle.add({of + "line_color", of + "line_opacity", of + "spacing_deg"}, "has no effect while line_width_deg is 0");
    } else if (never("line_opacity", shell.line_opacity)) {
      idle.add({of + "line_color", of + "line_width_deg", of + "spacing_deg"}, "has no effect while line_opacity is 0");
    }
    if (never("fill_opacity", shell.fill_opacity)) {
      idle.add({of + "fill_color", of + "texture"}, "has no effect while fill_opacity is 0");
    }
  }
}

void add_view(const Show& show, Idle& idle) {
  const ViewProjection projection = show.view.projection;
  if (projection != ViewProjection::dome) {
    idle.add({"view.tilt_deg"}, "is used only with projection = \"dome\"");
  }
  if (projection != ViewProjection::dome && projection != ViewProjection::pinhole) {
    idle.add({"view.vignette"}, "is used only with projection = \"dome\" or \"pinhole\"");
  }
  if (show.view.frustum) {
    idle.add({"view.aspect", "view.fov_deg"}, "is replaced by view.frustum");
  } else if (projection != ViewProjection::pinhole) {
    idle.add({"view.aspect"}, "is used only with projection = \"pinhole\"");
  }
  if (projection == ViewProjection::equirect || projection == ViewProjection::cube) {
    idle.add({"view.fov_deg"}, "has no effect: this projection shows the whole sphere");
  }
}

}  // namespace

std::vector<IdleLine> idle_lines(const Show& show) {
  Idle idle(show);
  add_keys(show_keys(), "", show, &show, idle);
  if (show.disk && show.disk->pattern == DiskPattern::none) {
    idle.add({"disk.contrast", "disk.speed"}, "is used only with pattern = \"procedural\"");
  }
  if (show.camera.orbit && show.camera.orbit->least_r() > (1.0 + 1e-9) * show.camera.fall->least_r) {
    idle.add({"camera.fall.least_r"}, "has no effect: the fall never comes this close to the hole");
  }
  add_sky(show, idle);
  add_light(show, idle);
  add_objects(show, idle);
  add_shells(show, idle);
  add_view(show, idle);
  return idle.in_order();
}

}  // namespace ergodome
