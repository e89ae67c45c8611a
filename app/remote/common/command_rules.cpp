#include "app/remote/common/command_rules.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <memory>
#include <vector>

#include "content/files/toml_table.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

using Kind = TransportCommand::Kind;

constexpr double max_chapters = 10'000;
constexpr double max_steps = 1e6;
constexpr std::size_t longest_tag = 35;  // size of buffers that BCP 47 recommends

constexpr std::array rules = {
    CommandRule{Kind::play, "play"},
    CommandRule{Kind::pause, "pause"},
    CommandRule{Kind::toggle_pause, "toggle_pause"},
    CommandRule{Kind::seek, "seek", Argument::number, 0.0, max_show_time_s},
    CommandRule{Kind::seek_by, "seek_by", Argument::number, -max_show_time_s, max_show_time_s},
    CommandRule{Kind::step, "step", Argument::whole, -max_steps, max_steps},
    CommandRule{Kind::speed, "speed", Argument::number, -max_speed, max_speed},
    CommandRule{Kind::chapter, "chapter", Argument::chapter, 0.0, max_chapters},
    CommandRule{Kind::next_chapter, "next_chapter"},
    CommandRule{Kind::previous_chapter, "previous_chapter"},
    CommandRule{Kind::loop, "loop", Argument::flag},
    CommandRule{Kind::blackout, "blackout", Argument::flag},
    CommandRule{Kind::toggle_blackout, "toggle_blackout"},
    CommandRule{Kind::exposure, "exposure", Argument::number, -20.0, 20.0},
    CommandRule{Kind::baseline, "baseline", Argument::number, 0.0, 1e6},
    CommandRule{Kind::language, "language", Argument::language_tag},
    CommandRule{Kind::next_language, "next_language"},
    CommandRule{Kind::captions, "captions", Argument::flag},
    CommandRule{Kind::volume, "volume", Argument::number, 0.0, 1.0},
    CommandRule{Kind::free_flight, "free_flight"},
    CommandRule{Kind::return_to_path, "return"},
    CommandRule{Kind::reset, "reset"},
    CommandRule{Kind::reload, "reload"},
};

//! Returns a text without case differences (all scripts). Text that is not UTF-8 stays unchanged.
std::string without_case(const std::string& text) {
  if (g_utf8_validate(text.data(), static_cast<gssize>(text.size()), nullptr) == FALSE) {
    return text;
  }
  const std::unique_ptr<gchar, decltype(&g_free)> folded(g_utf8_casefold(text.data(), static_cast<gssize>(text.size())),
                                                         &g_free);
  const std::unique_ptr<gchar, decltype(&g_free)> normalized(g_utf8_normalize(folded.get(), -1, G_NORMALIZE_DEFAULT),
                                                             &g_free);
  return normalized ? normalized.get() : text;
}

double whole_number(std::string_view location, double number, double minimum, double maximum) {
  if (std::trunc(checked_number(location, number, minimum, maximum)) != number) {
    throw Error(std::string(location), fmt::format("{} is not a whole number", number),
                "send a number without a fraction");
  }
  return number;
}

//! Parses a Boolean; also accepts 0 and 1.
bool truth(std::string_view location, const CommandArgument& argument) {
  if (const bool* const given = std::get_if<bool>(&argument)) {
    return *given;
  }
  const double* const number = std::get_if<double>(&argument);
  if (number == nullptr || (*number != 0.0 && *number != 1.0)) {
    throw Error(std::string(location), "needs true or false", "send true, false, 1 or 0");
  }
  return *number == 1.0;
}

double number_of(std::string_view location, const CommandArgument& argument) {
  const double* const number = std::get_if<double>(&argument);
  if (number == nullptr) {
    throw Error(std::string(location), "needs a number", "add one to the command");
  }
  return *number;
}

std::string language_of(std::string_view location, const CommandArgument& argument) {
  const std::string* const tag = std::get_if<std::string>(&argument);
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; };
  if (tag == nullptr || tag->size() > longest_tag || !std::all_of(tag->begin(), tag->end(), fits)) {
    throw Error(std::string(location), "needs a language tag", "send one such as \"en\" or \"de\"");
  }
  return *tag;
}

//! Normalizes a language tag for comparison (BCP 47): lower case, parts joined by dashes.
std::string plain_tag(std::string tag) {
  std::ranges::replace(tag, '_', '-');
  return without_case(tag);
}

//! Returns the show's tag for a language, or for a wider language ("de" for "de-AT"). Throws Error
//! if it has neither.
std::string checked_language(std::string_view location, const CommandArgument& argument,
                             const std::vector<std::string>& spoken) {
  const std::string tag = language_of(location, argument);
  for (std::string wanted = plain_tag(tag); !wanted.empty();
       wanted.resize(wanted.find('-') == std::string::npos ? 0 : wanted.rfind('-'))) {
    const auto found = std::ranges::find(spoken, wanted, plain_tag);
    if (found != spoken.end()) {
      return *found;
    }
  }
  throw Error(std::string(location), fmt::format("\"{}\" is not available in this show", tag),
              spoken.empty() ? "it has only one language" : fmt::format("choose from {}", fmt::join(spoken, ", ")));
}

//! Returns the index of the chapter with a title: first an exact match, then ignoring case, each
//! first in the current language, then in others. Throws Error if no chapter has the title.
double index_of_title(std::string_view location, const std::string& title, const std::vector<ChapterStatus>& chapters) {
  const auto as_it_is = [](const std::string& text) { return text; };
  const auto find = [&](const auto& change, bool all) {
    const std::string wanted = change(title);
    return std::ranges::find_if(chapters, [&](const ChapterStatus& chapter) {
      return change(chapter.title) == wanted ||
             (all &&
              std::ranges::any_of(chapter.titles, [&](const std::string& each) { return change(each) == wanted; }));
    });
  };
  for (const auto& found :
       {find(as_it_is, false), find(as_it_is, true), find(without_case, false), find(without_case, true)}) {
    if (found != chapters.end()) {
      return static_cast<double>(found - chapters.begin());
    }
  }
  throw Error(std::string(location), "no chapter has this title",
              chapters.empty() ? "this show has no chapters"
                               : "choose another; the first is \"" + chapters.front().title + "\"");
}

double chapter_index(const CommandRule& rule, const CommandArgument& argument, const PlayerStatus& status) {
  if (const std::string* const title = std::get_if<std::string>(&argument)) {
    return index_of_title(rule.name, *title, status.chapters);
  }
  const double count = static_cast<double>(status.chapters.size());
  const double index = whole_number(rule.name, number_of(rule.name, argument), rule.minimum, rule.maximum);
  if (index >= count) {
    throw Error(std::string(rule.name), fmt::format("chapter {} does not exist", index),
                count == 0 ? "this show has no chapters" : fmt::format("the last is chapter {}", count - 1));
  }
  return index;
}

}  // namespace

std::span<const CommandRule> command_rules() { return rules; }

const CommandRule* rule_of(std::string_view name) {
  const auto* const found =
      std::find_if(rules.begin(), rules.end(), [&](const CommandRule& rule) { return rule.name == name; });
  return found == rules.end() ? nullptr : found;
}

std::string nearest_command(std::string_view word, std::span<const std::string_view> others) {
  // A long word is not close to any name.
  if (word.size() > longest_tag) {
    return {};
  }
  std::vector<std::string> names(others.begin(), others.end());
  for (const CommandRule& rule : rules) {
    names.emplace_back(rule.name);
  }
  return nearest_word(word, names);
}

double checked_number(std::string_view location, double number, double minimum, double maximum) {
  if (!std::isfinite(number)) {
    throw Error(std::string(location), "the number is not finite", "send a finite number");
  }
  if (number < minimum || number > maximum) {
    throw Error(std::string(location), fmt::format("{} is out of range", number),
                fmt::format("send a number from {} to {}", minimum, maximum));
  }
  return number;
}

std::string refusal_now(const CommandRule& rule, const PlayerStatus& status) {
  if (moves_time(rule.kind) && !status.follows.empty()) {
    return fmt::format("the show's time follows {}", status.follows);
  }
  const auto chapters = static_cast<int>(status.chapters.size());
  if ((rule.kind == Kind::chapter || rule.kind == Kind::next_chapter) && chapters == 0) {
    return "this show has no chapters";
  }
  if (rule.kind == Kind::next_chapter && status.chapter + 1 >= chapters) {
    return "this is the last chapter";
  }
  return rule.kind == Kind::language && status.languages.empty() ? "this show has only one language" : "";
}

TransportCommand checked_command(const CommandRule& rule, const CommandArgument& argument, const PlayerStatus& status) {
  if (moves_time(rule.kind) && !status.follows.empty()) {
    throw Error(std::string(rule.name), refusal_now(rule, status),
                "change the time at that source, or restart the player without --clock");
  }
  TransportCommand command = {rule.kind, 0.0, {}};
  switch (rule.argument) {
    case Argument::none:
      break;
    case Argument::number:
      command.value = checked_number(rule.name, number_of(rule.name, argument), rule.minimum, rule.maximum);
      break;
    case Argument::whole:
      command.value = std::holds_alternative<std::monostate>(argument)
                          ? 1.0
                          : whole_number(rule.name, number_of(rule.name, argument), rule.minimum, rule.maximum);
      break;
    case Argument::flag:
      command.value = truth(rule.name, argument) ? 1.0 : 0.0;
      break;
    case Argument::language_tag:
      command.text = checked_language(rule.name, argument, status.languages);
      break;
    case Argument::chapter:
      command.value = chapter_index(rule, argument, status);
      break;
  }
  return command;
}

}  // namespace ergodome
