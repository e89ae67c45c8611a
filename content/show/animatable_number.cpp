#include "content/show/animatable_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "content/show/shell_numbers.h"
#include "content/show/show_schema.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

constexpr NumberChange picture{};
constexpr NumberChange stars{true, false, false};
constexpr NumberChange sky{true, true, false};

//! Returns an entry of the list. `place(show)` returns a pointer to the number in a const or
//! mutable show, or nullptr.
template <class Place>
AnimatableNumber number(std::string_view path, double least, double greatest, const NumberChange& change, Place) {
  return {std::string(path),
          {least, greatest},
          change,
          [](const Show& show) {
            const double* const at = Place{}(show);
            return at != nullptr ? std::optional(*at) : std::nullopt;
          },
          [](Show& show, double value) {
            if (double* const at = Place{}(show)) {
              *at = value;
            }
          }};
}

//! Returns a pointer to a member of an optional part of a show, or nullptr if it is absent.
constexpr auto part_of(auto& part, auto member) -> decltype(&((*part).*member)) {
  return part ? &((*part).*member) : nullptr;
}

const std::array numbers = {
    number("camera.fall.clock", 0.0, 1e9, picture,
           [](auto& show) { return part_of(show.camera.fall, &FallSettings::clock); }),
    number("sky.exposure", 0.0, 1e12, stars, [](auto& show) { return &show.sky.exposure; }),
    number("sky.faintest_mag", -30.0, 60.0, stars, [](auto& show) { return &show.sky.faintest_mag; }),
    number("sky.spin_axis.ra_deg", -360.0, 360.0, sky, [](auto& show) { return &show.sky.spin_axis_ra_deg; }),
    number("sky.spin_axis.dec_deg", -90.0, 90.0, sky, [](auto& show) { return &show.sky.spin_axis_dec_deg; }),
    number("disk.outer", 1.0, 1e6, picture, [](auto& show) { return part_of(show.disk, &DiskSettings::outer); }),
    number("disk.temperature_K", 300.0, 1e7, picture,
           [](auto& show) { return part_of(show.disk, &DiskSettings::temperature_k); }),
    number("disk.opacity", 0.0, 1.0, picture, [](auto& show) { return part_of(show.disk, &DiskSettings::opacity); }),
    number("disk.exposure", 0.0, 1e12, picture, [](auto& show) { return part_of(show.disk, &DiskSettings::exposure); }),
    number("disk.contrast", 0.0, 4.0, picture, [](auto& show) { return part_of(show.disk, &DiskSettings::contrast); }),
    number("view.fov_deg", 1e-6, 360.0, picture, [](auto& show) { return &show.view.field_of_view_deg; }),
    number("view.vignette", 0.0, 1.0, picture, [](auto& show) { return &show.view.vignette; }),
    number("view.tilt_deg", -180.0, 180.0, picture, [](auto& show) { return &show.view.tilt_deg; }),
};

struct Reason {
  std::string_view path;
  const char* reason;
};

constexpr const char* of_the_picture = "all frames of a show have the same size";
constexpr const char* of_the_screen = "it describes the screen, which does not change during a show";
constexpr std::array fixed_numbers = {
    Reason{"duration_s", "a show has only one duration"},
    Reason{"frame_rate_hz", "a show has only one frame rate"},
    Reason{"disk.inner", "to let it follow the spin, write inner = \"isco\""},
    Reason{"disk.speed", "changing it would make the clouds jump"},
    Reason{"view.size_px", of_the_picture},
    Reason{"view.aspect", of_the_picture},
    Reason{"view.height_deg", of_the_picture},
    Reason{"view.frustum", of_the_screen},
    Reason{"view.truncate", of_the_screen},
    Reason{"view.viewer", of_the_screen},
    Reason{"view.polynomial", of_the_screen},
    Reason{"camera.observer", "the kind of observer is the same for the whole show"},
    Reason{"camera", "to move the camera, write [[camera.key]]"},
};

//! A key on the way from a show to a number; of a list, its entry.
struct Step {
  const ShowKey* key;
  std::size_t entry;
};
using Steps = std::vector<Step>;

//! Returns a pointer to a number, or nullptr if the show lacks a part on the way to it.
double* number_at(const Show& show, const Steps& steps) {
  void* at = const_cast<Show*>(&show);
  for (const Step& step : steps) {
    at = at != nullptr ? step.key->at(at, step.entry) : nullptr;
  }
  return static_cast<double*>(at);
}

//! Adds the numbers among these keys and those in the tables below them.
void add_numbers(std::span<const ShowKey> keys, const std::string& path, const Steps& steps,
                 std::vector<AnimatableNumber>& numbers) {
  for (const ShowKey& key : keys) {
    for (std::size_t i = 0; i < std::max<std::size_t>(key.most, 1); ++i) {
      Steps way = steps;
      way.push_back({&key, i});
      const std::string own =
          path + std::string(key.name) + (key.kind == KeyKind::tables ? fmt::format("[{}]", i) : "");
      add_numbers(key.keys, own + ".", way, numbers);
      if (key.changes) {
        numbers.push_back({own, key.limits, *key.changes,
                           [way](const Show& show) {
                             const double* const at = number_at(show, way);
                             return at != nullptr ? std::optional(*at) : std::nullopt;
                           },
                           [way](Show& show, double value) {
                             if (double* const at = number_at(show, way)) {
                               *at = value;
                             }
                           }});
      }
    }
  }
}

//! Returns why the key at a path below these keys cannot be animated, or nullptr.
const char* why_fixed(std::span<const ShowKey> keys, std::string_view path) {
  const std::string_view name = path.substr(0, path.find('.'));
  const auto key = std::ranges::find(keys, name, &ShowKey::name);
  if (key == keys.end() || key->fixed != nullptr) {
    return key == keys.end() ? nullptr : key->fixed;
  }
  return name.size() < path.size() ? why_fixed(key->keys, path.substr(name.size() + 1)) : nullptr;
}

}  // namespace

NumberChange& NumberChange::operator|=(const NumberChange& other) {
  stars = stars || other.stars;
  sky = sky || other.sky;
  exposure = exposure || other.exposure;
  return *this;
}

std::span<const AnimatableNumber> animatable_numbers() {
  static const std::vector<AnimatableNumber> all = [] {
    std::vector<AnimatableNumber> list(numbers.begin(), numbers.end());
    add_numbers(show_keys(), "", {}, list);
    list.insert(list.end(), shell_numbers().begin(), shell_numbers().end());
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
  NumberLimits limits = number.limits;
  if (number.path != "view.fov_deg") {
    return limits;
  }
  if (show.view.projection == ViewProjection::pinhole) {
    limits.greatest = widest_pinhole_deg;
  } else if (show.view.projection == ViewProjection::dome) {
    const auto& f = show.view.polynomial;
    limits.greatest =
        std::min(limits.greatest, 2.0 * radian_deg * largest_half_angle(show.view.lens, {f[0], f[1], f[2], f[3]}));
  }
  return limits;
}

std::optional<std::string> why_not_animatable(std::string_view path) {
  if (const char* const reason = why_fixed(show_keys(), path)) {
    return reason;
  }
  for (const Reason& each : fixed_numbers) {
    if (path.starts_with(each.path) && (path.size() == each.path.size() || path[each.path.size()] == '.')) {
      return each.reason;
    }
  }
  return std::nullopt;
}

}  // namespace ergodome
