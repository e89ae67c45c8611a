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
  bool stars = false;     //!< stars are found or drawn differently
  bool sky = false;       //!< map and stars must be read and rotated again, which takes a good part of a second
  bool exposure = false;  //!< automatic exposure reacts differently

  NumberChange& operator|=(const NumberChange& other);
};

//! The range of a number, both ends included.
struct NumberLimits {
  double least;
  double greatest;
};

struct ShowKey;

//! A number of a show that can be animated: one whose key is declared so. Integers, and numbers that
//! belong to the screen or to the size of the image, cannot.
struct AnimatableNumber {
  //! A key on the way from the whole file to the number; of a list of tables, one entry.
  struct Step {
    const ShowKey* key;
    std::size_t entry;
  };

  std::string path;     //!< its path in the file: "hole.spin"
  NumberLimits limits;  //!< of its own key, in any show
  NumberChange change;
  std::vector<Step> steps;

  //! Returns nothing if the show lacks the part.
  [[nodiscard]] std::optional<double> get(const Show& show) const;
  //! Does nothing if the show lacks the part.
  void put(Show& show, double value) const;
};

//! Returns all animatable numbers.
std::span<const AnimatableNumber> animatable_numbers();

//! Returns the animatable number with this path, or nullptr.
const AnimatableNumber* find_animatable(std::string_view path);

//! Returns the limits of the number with this path for its own key. The number must exist.
NumberLimits limits_of(std::string_view path);

//! Returns the limits in a show whose view and other parts have been read: some lenses have a
//! smaller maximum field of view.
NumberLimits limits_in(const Show& show, const AnimatableNumber& number);

//! Returns why a number that is not in the list cannot be animated, and the remedy; nothing if the
//! path is not a number of shows.
std::optional<std::string> why_not_animatable(std::string_view path);

}  // namespace ergodome
