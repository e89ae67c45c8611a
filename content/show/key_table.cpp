#include "content/show/key_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "content/timeline/local_text.h"
#include "kernels/core/angles.h"

namespace ergodome {

namespace {

std::int32_t word_at(const void* value) {
  std::int32_t word = 0;
  std::memcpy(&word, value, sizeof(word));
  return word;
}

void read_whole_table(const ShowKey& key, TomlTable&& table, void* settings) {
  read_keys(key.keys, table, settings);
  table.refuse_unknown_keys();
}

//! Reads a table, or the tables of a list.
void read_tables(const ShowKey& key, TomlTable& table, void* settings) {
  if (key.kind == KeyKind::table) {
    if (const toml::table* const below = table.table(key.name)) {
      read_whole_table(key, table.below(*below, key.name),
                       key.make != nullptr ? key.make(settings) : key.at(settings, 0));
    }
    return;
  }
  std::size_t i = 0;
  for (const toml::table* const each : table.tables(key.name, key.max_tables)) {
    read_whole_table(key, table.below(*each, fmt::format("{}[{}]", key.name, i++)), key.make(settings));
  }
}

double unit_of(const ShowKey& key) { return key.degrees ? one_degree : 1.0; }

//! Returns a number as it is written to a file: an angle in degrees, limited to its range, because
//! rounding could exceed that.
double written_number(const ShowKey& key, double value) {
  return key.degrees ? std::clamp(value * radian_deg, key.limits.minimum, key.limits.maximum) : value;
}

//! Reads a value that is not a table.
void read_value(const ShowKey& key, TomlTable& table, void* settings) {
  void* value = key.at(settings, 0);
  if (key.kind == KeyKind::local_text) {
    *static_cast<LocalText*>(value) = read_local_text(table, key.name);
    return;
  }
  if (table.node(key.name) == nullptr) {
    return;
  }
  if (value == nullptr) {
    value = key.make(settings);
  }
  const NumberLimits limits = limits_of(key, settings);
  switch (key.kind) {
    case KeyKind::number:
      *static_cast<double*>(value) = unit_of(key) * table.number(key.name, 0.0, limits.minimum, limits.maximum);
      break;
    case KeyKind::integer:
      *static_cast<int*>(value) =
          table.integer(key.name, 0, static_cast<int>(limits.minimum), static_cast<int>(limits.maximum));
      break;
    case KeyKind::boolean:
      *static_cast<bool*>(value) = table.boolean(key.name, false);
      break;
    case KeyKind::text:
      *static_cast<std::string*>(value) = table.text(key.name, "");
      break;
    case KeyKind::vector: {
      const auto parts = table.numbers(key.name, 3, 3, limits.minimum, limits.maximum);
      *static_cast<Vector3<double>*>(value) = unit_of(key) * Vector3<double>{parts[0], parts[1], parts[2]};
      break;
    }
    case KeyKind::color:
      std::ranges::copy(table.numbers(key.name, 3, 3, limits.minimum, limits.maximum),
                        static_cast<std::array<double, 3>*>(value)->begin());
      break;
    default: {
      const std::int32_t word = key.first_word + table.choice(key.name, 0, key.words);
      std::memcpy(value, &word, sizeof(word));
    }
  }
}

void read_key(const ShowKey& key, TomlTable& table, void* settings) {
  if (key.applies != nullptr && !key.applies(settings)) {
    return;
  }
  if (key.missing != nullptr && !table.has(key.name)) {
    throw table.error_at(key.name, "is missing", key.missing);
  }
  if (key.before != nullptr) {
    key.before(table, settings);
  }
  if (key.read != nullptr) {
    key.read(table, settings);
  } else if (key.kind == KeyKind::part) {
    read_keys(key.keys, table, key.at(settings, 0));
  } else if (key.kind == KeyKind::table || key.kind == KeyKind::tables) {
    read_tables(key, table, settings);
  } else {
    read_value(key, table, settings);
  }
  if (key.after != nullptr) {
    key.after(table, settings);
  }
}

void write_value(const ShowKey& key, const void* value, toml::table& table) {
  switch (key.kind) {
    case KeyKind::number:
      table.insert(key.name, written_number(key, *static_cast<const double*>(value)));
      break;
    case KeyKind::vector: {
      const auto& v = *static_cast<const Vector3<double>*>(value);
      table.insert(key.name, toml::array{written_number(key, v.x), written_number(key, v.y), written_number(key, v.z)});
      break;
    }
    case KeyKind::integer:
      table.insert(key.name, *static_cast<const int*>(value));
      break;
    case KeyKind::boolean:
      table.insert(key.name, *static_cast<const bool*>(value));
      break;
    case KeyKind::text:
      table.insert(key.name, *static_cast<const std::string*>(value));
      break;
    case KeyKind::local_text:
      add_local_text(*static_cast<const LocalText*>(value), key.name, table);
      break;
    case KeyKind::color: {
      const auto& color = *static_cast<const std::array<double, 3>*>(value);
      table.insert(key.name, toml::array{color[0], color[1], color[2]});
      break;
    }
    case KeyKind::table:
      table.insert(key.name, written_keys(key.keys, value));
      break;
    case KeyKind::part:
      for (auto& [name, node] : written_keys(key.keys, value)) {
        table.insert(name, std::move(node));
      }
      break;
    default:
      table.insert(key.name, key.words[static_cast<std::size_t>(word_at(value) - key.first_word)]);
  }
}

}  // namespace

std::string path_below(const std::string& path, const ShowKey& key, std::size_t i) {
  return key.kind == KeyKind::part     ? path
         : key.kind == KeyKind::tables ? fmt::format("{}{}[{}].", path, key.name, i)
                                       : fmt::format("{}{}.", path, key.name);
}

void read_keys(std::span<const ShowKey> keys, TomlTable& table, void* settings) {
  for (const ShowKey& key : keys) {
    read_key(key, table, settings);
  }
}

toml::table written_keys(std::span<const ShowKey> keys, const void* settings) {
  toml::table table;
  for (const ShowKey& key : keys) {
    if ((key.applies != nullptr && !key.applies(settings)) || (key.written != nullptr && !key.written(settings))) {
      continue;
    }
    if (key.write != nullptr) {
      key.write(table, settings);
      continue;
    }
    const auto value = [&](std::size_t i) { return key.at(const_cast<void*>(settings), i); };
    if (key.kind == KeyKind::tables) {
      toml::array list;
      for (std::size_t i = 0; value(i) != nullptr; ++i) {
        list.push_back(written_keys(key.keys, value(i)));
      }
      if (!list.empty()) {
        table.insert(key.name, std::move(list));
      }
    } else if (value(0) != nullptr) {
      write_value(key, value(0), table);
    }
  }
  return table;
}

}  // namespace ergodome
