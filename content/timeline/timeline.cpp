#include "content/timeline/timeline.h"

#include <set>

namespace ergodome {

std::vector<std::string> languages(const Timeline& timeline) {
  std::set<std::string> tags;
  const auto note = [&](const LocalText& text) {
    for (const auto& [tag, words] : text) {
      tags.insert(tag);
    }
  };
  for (const Chapter& chapter : timeline.chapters) {
    note(chapter.title);
  }
  for (const Caption& caption : timeline.captions) {
    note(caption.text);
  }
  for (const AudioTrack& track : timeline.audio) {
    tags.insert(track.language);
  }
  tags.erase("");
  return {tags.begin(), tags.end()};
}

const std::string& text_in(const LocalText& text, std::string_view language) {
  static const std::string nothing;
  // Falls back from "de-AT" to "de".
  for (std::string asked(language); !asked.empty();) {
    if (const auto found = text.find(asked); found != text.end()) {
      return found->second;
    }
    const std::size_t end = asked.rfind('-');
    asked.resize(end != std::string::npos ? end : 0);
  }
  for (const char* usual : {"", "en"}) {
    if (const auto found = text.find(usual); found != text.end()) {
      return found->second;
    }
  }
  return text.empty() ? nothing : text.begin()->second;
}

}  // namespace ergodome
