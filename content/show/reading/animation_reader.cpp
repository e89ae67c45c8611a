#include "content/show/reading/animation_reader.h"

#include <fmt/format.h>

#include "content/show/animated_show.h"
#include "content/show/key_table.h"
#include "content/show/show_schema.h"

namespace ergodome {

namespace {

constexpr std::size_t max_animations = 1000;
constexpr std::size_t max_number_keys = 100'000;

const AnimatableNumber& number_of(TomlTable& table) {
  const std::string path = table.text("number", "");
  if (const AnimatableNumber* found = find_animatable(path)) {
    return *found;
  }
  if (path.empty()) {
    throw table.error_at("number", "is missing", "name the number to animate, for example number = \"hole.spin\"");
  }
  const std::string problem = fmt::format("is \"{}\"", path.substr(0, 60));
  if (const auto reason = why_not_animatable(path)) {
    throw table.error_at("number", problem + ", which cannot be animated", *reason);
  }
  std::vector<std::string> paths;
  for (const AnimatableNumber& each : animatable_numbers()) {
    // All shells have the same numbers, so only those of the first shell are listed.
    if (!each.path.starts_with("shells[") || each.path.starts_with("shells[0]")) {
      paths.emplace_back(each.path);
    }
  }
  const std::string nearest = nearest_word(path, paths);
  throw table.error_at("number", problem + ", which is not a number that can be animated",
                       nearest.empty() ? "see reference/show-keys.md in the documentation for those that can"
                                       : fmt::format("did you mean \"{}\"?", nearest));
}

//! Throws Error if the view does not use its field of view, or computes the height of the image
//! from it.
void check_field_of_view(const TomlTable& table, const ViewSettings& view) {
  const bool follows =
      view.projection == ViewProjection::dome || (view.projection == ViewProjection::pinhole && !view.frustum);
  if (!follows) {
    throw table.error_at("number",
                         "is \"view.fov_deg\", which this view does not use, or uses for the height of the picture",
                         "animate it only with projection = \"dome\", or with \"pinhole\" without a frustum");
  }
}

std::vector<NumberKey> read_keys(TomlTable& table, const std::string& file, const NumberLimits& limits) {
  std::vector<NumberKey> keys;
  for (const toml::table* each : table.tables("key", max_number_keys)) {
    TomlTable reader(*each, file, fmt::format("{}[{}]", table.path_of("key"), keys.size()));
    NumberKey key;
    // Checks the value against the number's own limits, which are narrower than the schema's.
    reader.number("value", 0.0, limits.minimum, limits.maximum);
    read_settings(number_key_keys, reader, key);
    if (!keys.empty() && !(key.time_s - keys.back().time_s >= min_key_gap_s)) {
      throw reader.error_at("t_s", "is not later than that of the previous key", "sort the keys by time");
    }
    reader.refuse_unknown_keys();
    keys.push_back(key);
  }
  if (keys.empty()) {
    table.refuse_unknown_keys();  // an unknown key may be a misspelled `key`
    throw table.error_at("key", "is missing", "write key = [{ t_s = 0, value = 0 }, { t_s = 10, value = 1 }]");
  }
  return keys;
}

Animation read_animation(TomlTable& table, const std::string& file, const Show& show) {
  const AnimatableNumber& number = number_of(table);
  if (find_animation(show, number.path) != nullptr) {
    throw table.error_at("number", fmt::format("is \"{}\", which is animated twice", number.path),
                         "put all its keys into one [[animate]]");
  }
  if (!number.get(show)) {
    const std::string_view part = std::string_view(number.path).substr(0, number.path.rfind('.'));
    throw table.error_at("number", fmt::format("is \"{}\", but the show has no {}", number.path, part),
                         part.find('[') == std::string_view::npos
                             ? fmt::format("add [{}] to the show", part)
                             : fmt::format("add another [[{}]]", part.substr(0, part.find('['))));
  }
  if (number.path == "view.fov_deg") {
    check_field_of_view(table, show.view);
  }
  return {std::string(number.path), read_keys(table, file, limits_in(show, number))};
}

//! Returns the range of a number over the whole show, animated or fixed.
NumberLimits values_of(const Show& show, std::string_view path) {
  if (const Animation* animation = find_animation(show, path)) {
    return range_of(*animation);
  }
  const double fixed = find_animatable(path)->get(show).value_or(0.0);
  return {fixed, fixed};
}

//! Throws Error if one of the numbers is animated and `lower` does not stay below `upper` by at
//! least `gap`. The ranges over the whole show are compared, so they must not overlap, even where
//! their values occur at different times.
void check_order(const TomlTable& root, const Show& show, std::string_view lower, std::string_view upper, double gap) {
  const double highest = values_of(show, lower).maximum;
  const double lowest = values_of(show, upper).minimum;
  if (lowest - highest < gap && (find_animation(show, lower) != nullptr || find_animation(show, upper) != nullptr)) {
    throw root.error_at(
        "animate", fmt::format("raises {} to {}, while {} is as low as {}", lower, highest, upper, lowest),
        gap > 0.0 ? fmt::format("keep them at least {} apart", gap) : "keep the first at or below the second");
  }
}

}  // namespace

void read_animations(TomlTable& root, const std::string& file, Show& show) {
  for (const toml::table* each : root.tables("animate", max_animations)) {
    TomlTable table(*each, file, fmt::format("animate[{}]", show.timeline.animations.size()));
    Animation animation = read_animation(table, file, show);
    table.refuse_unknown_keys();
    show.lines["animate." + animation.path] =
        is_from(each->source(), file) ? static_cast<int>(each->source().begin.line) : key_set_outside;
    show.timeline.animations.push_back(std::move(animation));
  }
  check_order(root, show, "stereo.fade.from_deg", "stereo.fade.to_deg", min_fade_deg);
  check_order(root, show, "tone.auto.least_stops", "tone.auto.most_stops", 0.0);
}

}  // namespace ergodome
