#include "content/show/shell_numbers.h"

#include <fmt/format.h>

#include <deque>
#include <utility>

namespace ergodome {

namespace {

//! Returns a pointer to a number of a shell, or nullptr if the show has no such shell.
template <std::size_t Shell, double ShellSettings::*Member>
auto place(auto& show) -> decltype(&(show.shells[Shell].*Member)) {
  return Shell < show.shells.size() ? &(show.shells[Shell].*Member) : nullptr;
}

template <std::size_t Shell, double ShellSettings::*Member>
std::optional<double> get(const Show& show) {
  const double* const at = place<Shell, Member>(show);
  return at != nullptr ? std::optional(*at) : std::nullopt;
}

template <std::size_t Shell, double ShellSettings::*Member>
void put(Show& show, double value) {
  if (double* const at = place<Shell, Member>(show)) {
    *at = value;
  }
}

//! The list, together with the strings that its string views refer to.
struct Numbers {
  std::deque<std::string> paths;
  std::vector<AnimatableNumber> numbers;

  template <std::size_t Shell, double ShellSettings::*Member>
  void add(const char* key, const NumberLimits& limits) {
    paths.push_back(fmt::format("shells[{}].{}", Shell, key));
    numbers.push_back({paths.back(), limits, {}, &get<Shell, Member>, &put<Shell, Member>});
  }

  template <std::size_t Shell>
  void add_shell() {
    add<Shell, &ShellSettings::radius>("radius", {1.0, 1e9});
    add<Shell, &ShellSettings::line_width_deg>("line_width_deg", {0.0, 90.0});
    add<Shell, &ShellSettings::line_opacity>("line_opacity", {0.0, 1.0});
    add<Shell, &ShellSettings::fill_opacity>("fill_opacity", {0.0, 1.0});
    add<Shell, &ShellSettings::exposure>("exposure", {0.0, 1e12});
  }

  template <std::size_t... Shells>
  explicit Numbers(std::index_sequence<Shells...> /*all*/) {
    (add_shell<Shells>(), ...);
  }
};

}  // namespace

const std::vector<AnimatableNumber>& shell_numbers() {
  static const Numbers all{std::make_index_sequence<most_shells>()};
  return all.numbers;
}

}  // namespace ergodome
