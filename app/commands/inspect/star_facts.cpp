#include "app/commands/inspect/star_facts.h"

#include <fmt/format.h>

#include <string>

#include "content/files/console.h"
#include "content/files/counted.h"

namespace ergodome {

nlohmann::json facts_of_stars(const Show& show, const ShowNotes& notes) {
  nlohmann::json facts = {
      {"catalogue", show.sky.stars}, {"count", notes.stars.value_or(0)}, {"left_out", nlohmann::json::array()}};
  for (const RowsLeftOut& rows : notes.left_out) {
    facts["left_out"].push_back({{"why", rows.why}, {"rows", rows.count}, {"first_line", rows.first_line}});
  }
  if (!notes.left_out.empty()) {
    facts["text"] = text_of(notes.left_out);
  }
  if (!notes.stars_read_as.empty()) {
    facts["read_as"] = notes.stars_read_as;
  }
  return facts;
}

void print_stars(const nlohmann::json& facts) {
  print_out("{:<16}{}: {}{}\n", "stars", facts["catalogue"].get<std::string>(),
            counted(facts["count"].get<std::size_t>(), "star"),
            facts.contains("text") ? ", " + facts["text"].get<std::string>() : "");
  if (facts.contains("read_as")) {
    print_out("{:<16}read as {}\n", "", facts["read_as"].get<std::string>());
  }
}

}  // namespace ergodome
