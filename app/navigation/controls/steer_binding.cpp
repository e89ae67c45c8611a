#include "app/navigation/controls/steer_binding.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

namespace ergodome {

std::vector<std::string> words_of(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) {
    words.push_back(std::move(word));
  }
  return words;
}

std::optional<Controls::SteerBinding> steer_binding_of(std::string_view text) {
  double scale = 1.0;
  if (const std::size_t star = text.find('*'); star != std::string_view::npos) {
    const std::string factor(text.substr(0, star));
    char* end = nullptr;
    scale = std::strtod(factor.c_str(), &end);
    if (factor.empty() || end != factor.c_str() + factor.size() || !(std::abs(scale) <= 100.0) || scale == 0.0) {
      return std::nullopt;
    }
    text.remove_prefix(star + 1);
  } else if (text.starts_with('-')) {
    scale = -1.0;
    text.remove_prefix(1);
  }
  const auto input = input_of(text);
  if (!input || input->kind == Input::Kind::wheel_step) {
    return std::nullopt;
  }
  return Controls::SteerBinding{*input, scale};
}

std::string text_of(const Controls::SteerBinding& binding) {
  std::string name = name_of(binding.input);
  if (binding.scale == 1.0) {
    return name;
  }
  return binding.scale == -1.0 ? fmt::format("-{}", name) : fmt::format("{}*{}", binding.scale, name);
}

}  // namespace ergodome
