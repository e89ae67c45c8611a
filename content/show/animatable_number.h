#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "content/show/show.h"

namespace ergodome {

//! What a change of a number calls for, beside another picture.
struct NumberChange {
  bool stars = false;     //!< stars are found or drawn otherwise
  bool sky = false;       //!< map and stars are read and turned anew: a good part of a second
  bool exposure = false;  //!< exposure follows the light otherwise

  NumberChange& operator|=(const NumberChange& other);
};

//! What a number may be, ends included.
struct NumberLimits {
  double least;
  double greatest;
};

//! Of a picture on a flat screen.
inline constexpr double widest_pinhole_deg = 179.0;

//! A number of a show that may change with time. Whole numbers, and what belongs to the screen or to the size of its picture, may not.
struct AnimatableNumber {
  std::string_view path;  //!< its place in the file: "hole.spin"
  NumberLimits limits;    //!< of its own key, in any show
  NumberChange change;
  std::optional<double> (*get)(const Show&);  //!< nothing where the show has no such part
  void (*put)(Show&, double);                 //!< where it has
};

//! All of them.
std::span<const AnimatableNumber> animatable_numbers();

//! One of them by its path, or nullptr.
const AnimatableNumber* find_animatable(std::string_view path);

//! Limits of the number with this path, for its own key. There must be one.
NumberLimits limits_of(std::string_view path);

//! The limits in a show whose view and parts have been read: a lens may see less than others do.
NumberLimits limits_in(const Show& show, const AnimatableNumber& number);

//! Why a path that is not in the list cannot be animated, and what to do; nothing where it is no number of a show at all.
std::optional<std::string> why_not_animatable(std::string_view path);

}  // namespace ergodome
