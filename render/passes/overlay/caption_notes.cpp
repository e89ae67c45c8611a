#include "render/passes/overlay/caption_notes.h"

#include <fmt/format.h>

#include <map>

#include "render/passes/overlay/caption_image.h"

namespace ergodome {

namespace {

//! Returns the first letters of a text, with dots if there are more. Continuation bytes of UTF-8
//! are 10xxxxxx.
std::string first_letters(const std::string& text) {
  constexpr int max_letters = 12;
  int letters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U;
    letters += begins ? 1 : 0;
    if (letters > max_letters) {
      return text.substr(0, i) + "...";
    }
  }
  return text;
}

}  // namespace

std::vector<std::string> notes_of_captions(const Show& show) {
  std::map<std::string, std::string> missing;
  for (const Caption& caption : show.timeline.captions) {
    for (const auto& [language, text] : caption.text) {
      missing[language] += letters_without_font(text);
    }
  }
  std::vector<std::string> notes;
  for (const auto& [language, letters] : missing) {
    if (!letters.empty()) {
      notes.push_back(fmt::format(
          "{}: no installed font has the letters {} of captions{}; they are drawn as boxes. Install "
          "a font that has them (fonts-noto-cjk for Chinese, Japanese and Korean)",
          show.name, first_letters(letters_without_font(letters)), language.empty() ? "" : " in " + language));
    }
  }
  return notes;
}

}  // namespace ergodome
