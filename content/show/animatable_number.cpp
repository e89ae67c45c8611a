#include "content/show/animatable_number.h"

#include <algorithm>
#include <stdexcept>

#include "content/show/show_schema.h"

namespace ergodome {

namespace {

using Steps = std::span<const AnimatableNumber::Step>;

//! Returns the struct or number in a show to which the steps lead, or nullptr if the show does not
//! have it.
void* part_at(const Show& show, Steps steps) {
  void* at = const_cast<Show*>(&show);
  for (const auto& [key, entry] : steps) {
    at = at != nullptr ? key->at(at, entry) : nullptr;
  }
  return at;
}

bool has_number(const ShowKey& key) { return key.changes || std::ranges::any_of(key.keys, has_number); }

//! Adds the animatable numbers among these keys and in the tables below them.
void add_numbers(std::span<const ShowKey> keys, const std::string& path, Steps steps,
                 std::vector<AnimatableNumber>& numbers) {
  for (const ShowKey& key : keys) {
    for (std::size_t i = 0; has_number(key) && i < std::max<std::size_t>(key.max_tables, 1); ++i) {
      AnimatableNumber number{path + std::string(key.name), key.limits, key.changes.value_or(NumberChange{}), {}};
      number.steps.assign(steps.begin(), steps.end());
      number.steps.push_back({&key, i});
      add_numbers(key.keys, path_below(path, key, i), number.steps, numbers);
      if (key.changes) {
        numbers.push_back(std::move(number));
      }
    }
  }
}

//! Returns why the key at a path below these keys cannot be animated, or nullptr.
const char* why_fixed(std::span<const ShowKey> keys, std::string_view path) {
  const std::string_view name = path.substr(0, path.find('.'));
  const auto key = std::ranges::find(keys, name, &ShowKey::name);
  if (key == keys.end()) {
    return nullptr;
  }
  const char* const below = name.size() < path.size() ? why_fixed(key->keys, path.substr(name.size() + 1)) : nullptr;
  return below != nullptr ? below : key->fixed;
}

}  // namespace

NumberChange& NumberChange::operator|=(const NumberChange& other) {
  stars = stars || other.stars;
  sky = sky || other.sky;
  exposure = exposure || other.exposure;
  return *this;
}

std::optional<double> AnimatableNumber::get(const Show& show) const {
  const void* const at = part_at(show, steps);
  return at != nullptr ? std::optional(*static_cast<const double*>(at)) : std::nullopt;
}

void AnimatableNumber::put(Show& show, double value) const {
  if (void* const at = part_at(show, steps)) {
    *static_cast<double*>(at) = value;
  }
}

std::span<const AnimatableNumber> animatable_numbers() {
  static const std::vector<AnimatableNumber> all = [] {
    std::vector<AnimatableNumber> list;
    add_numbers(show_keys(), "", {}, list);
    return list;
  }();
  return all;
}

const AnimatableNumber* find_animatable(std::string_view path) {
  const auto all = animatable_numbers();
  const auto found = std::ranges::find(all, path, &AnimatableNumber::path);
  return found != all.end() ? &*found : nullptr;
}

NumberLimits limits_of(std::string_view path) {
  const AnimatableNumber* const found = find_animatable(path);
  if (found == nullptr) {
    throw std::logic_error("unknown animatable number: " + std::string(path));
  }
  return found->limits;
}

NumberLimits limits_in(const Show& show, const AnimatableNumber& number) {
  const void* const settings = part_at(show, Steps(number.steps).first(number.steps.size() - 1));
  return settings != nullptr ? limits_of(*number.steps.back().key, settings) : number.limits;
}

std::optional<std::string> why_not_animatable(std::string_view path) {
  const char* const reason = why_fixed(show_keys(), path);
  return reason != nullptr ? std::optional<std::string>(reason) : std::nullopt;
}

}  // namespace ergodome
