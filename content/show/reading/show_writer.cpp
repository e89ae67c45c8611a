#include <sstream>

#include "content/show/key_table.h"
#include "content/show/reading/show_reader.h"
#include "content/show/show_schema.h"

namespace ergodome {

std::string to_toml(const Show& show) {
  std::ostringstream text;
  text << written_keys(show_keys(), &show) << '\n';
  return text.str();
}

}  // namespace ergodome
