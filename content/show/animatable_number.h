#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "content/show/show.h"

namespace ergodome {

//! The parts of a rendering that a change of a number invalidates; every change needs a new frame.
struct NumberChange {
  bool stars = false;  //!< stars are found or drawn differently
  //! Map and stars must be read and rotated again, which takes a considerable fraction of a second.
  bool sky = false;
  bool exposure = false;  //!< automatic exposure reacts differently

  NumberChange& operator|=(const NumberChange& other);
};

//! The range of a number, both ends included.
struct NumberLimits {
  double minimum;
  double maximum;
};

struct ShowKey;

//! A number of a show that can be animated, because the declaration of its key allows it. Integers,
//! and numbers that belong to the screen or to the size of the image, cannot be animated.
struct AnimatableNumber {
  //! One key on the path through the tables of the show file to the number; `entry` is the index if
  //! the key holds a list of tables.
  struct Step {
    const ShowKey* key;
    std::size_t entry;
  };

  std::string path;     //!< its path in the file: "hole.spin"
  NumberLimits limits;  //!< limits of its key alone, whatever the show's other keys are
  NumberChange change;
  std::vector<Step> steps;

  //! Returns the number; nothing if the show lacks the table that contains it.
  [[nodiscard]] std::optional<double> get(const Show& show) const;
  //! Sets the number; does nothing if the show lacks the table that contains it.
  void put(Show& show, double value) const;
};

std::span<const AnimatableNumber> animatable_numbers();

//! Returns the animatable number with this path, or nullptr.
const AnimatableNumber* find_animatable(std::string_view path);

//! Returns AnimatableNumber::limits of the number with this path, which must exist.
NumberLimits limits_of(std::string_view path);

//! Returns the limits of a number in a show: some lenses have a smaller maximum field of view. The
//! show's view and other parts must have been read.
NumberLimits limits_in(const Show& show, const AnimatableNumber& number);

//! Returns why the key at a path cannot be animated, with the remedy (ShowKey::fixed); nothing if
//! the path is unknown or no reason is declared.
std::optional<std::string> why_not_animatable(std::string_view path);

}  // namespace ergodome
