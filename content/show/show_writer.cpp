#include <sstream>

#include "content/objects/object_reader.h"
#include "content/show/key_table.h"
#include "content/show/show_reader.h"
#include "content/show/show_schema.h"

namespace ergodome {

std::string to_toml(const Show& show) {
  toml::table root = written_keys(show_keys(), &show);
  add_objects(show, root);
  std::ostringstream text;
  text << root << '\n';
  return text.str();
}

}  // namespace ergodome
