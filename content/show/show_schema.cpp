#include "content/show/show_schema.h"

namespace ergodome {

std::span<const ShowKey> show_keys() {
  static const auto all =
      keys_of<Show>(table<&Show::effects>("effects", effect_keys), table<&Show::tone>("tone", tone_keys));
  return all.keys;
}

}  // namespace ergodome
