#pragma once

#include <toml++/toml.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "content/files/toml_table.h"
#include "content/show/animatable_number.h"
#include "content/show/show.h"

// The schema of the show file. A key is declared once, in the table of its struct:
//
//   constexpr auto bloom_keys = keys_of<BloomSettings>(
//       key<&BloomSettings::strength>("strength", "Part of the light that is scattered.")
//           .range(0.0, 1.0)
//           .animated(),
//       key<&BloomSettings::radius_px>("radius_px", "Width of the halo.").range(0.0, 4096.0, "px"));
//
// The type follows from the member, the default from the member's initial value. Reader, writer,
// animatable numbers, unused keys and the tables of the reference pages follow from it.
namespace ergodome {

enum class KeyKind {
  number,
  integer,
  boolean,
  text,
  local_text,  //!< a text in several languages; always required
  word,        //!< one of a list of words: an enumeration
  color,       //!< three numbers: an array
  vector,      //!< three numbers: a Vector3
  table,       //!< a table; absent if its struct is an empty optional
  tables,      //!< a list of tables: a vector of structs
  part,        //!< a struct whose keys are in the table of the enclosing struct
  other        //!< any other value; the key has its own functions for reading and writing
};

//! Texts for a key's row in the tables of the reference pages. Empty ones are generated from the
//! declaration.
struct PageText {
  std::string_view type{};
  std::string_view unit{};
  std::string_view otherwise{};  //!< the default
  std::string_view bounds{};     //!< the range
  std::string_view varies{};     //!< whether it changes with time
};

//! Declaration of a key. All its functions receive the struct of the key's table as `settings`.
struct ShowKey {
  std::string_view name;
  KeyKind kind = KeyKind::other;
  //! Limits of a number, or of the numbers in a list, in the unit of the file.
  NumberLimits limits{0.0, 0.0};
  std::span<const char* const> words;  //!< allowed words, in the order of the enumeration's values
  std::int32_t first_word = 0;         //!< enumeration value of the first word
  std::span<const ShowKey> keys;       //!< keys of the table, for a table or a list of tables
  std::size_t max_tables = 0;          //!< maximum number of tables in a list
  bool degrees = false;                //!< the file has degrees, the member radians
  const char* missing = nullptr;       //!< remedy if the key is absent; nullptr: the key is optional
  //! Parts that change when the number is animated. Without a value, the number cannot be animated.
  std::optional<NumberChange> changes;
  const char* fixed = nullptr;  //!< why the key, or a key in this table, cannot be animated

  //! Returns a pointer to the value, or to entry `i` of a list; nullptr if it is absent.
  void* (*at)(void* settings, std::size_t i) = nullptr;
  //! Creates an absent value, or appends an entry to a list, and returns a pointer to it.
  void* (*make)(void* settings) = nullptr;
  void (*before)(TomlTable& table, void* settings) = nullptr;  //!< runs before the key is read
  void (*after)(TomlTable& table, void* settings) = nullptr;   //!< runs after the key was read
  //! Reads the key in place of the default reader for its kind; nullptr: the default reader is
  //! used.
  void (*read)(TomlTable& table, void* settings) = nullptr;
  void (*write)(toml::table& table, const void* settings) = nullptr;
  //! If it returns false, the key is treated as unknown.
  bool (*applies)(const void* settings) = nullptr;
  //! If it returns false, the writer omits the key.
  bool (*written)(const void* settings) = nullptr;
  //! Returns limits that depend on other keys.
  NumberLimits (*narrower)(const void* settings) = nullptr;
  //! Returns why the key is unused in a show, or nullptr if it is used.
  const char* (*unused)(const Show& show, const void* settings) = nullptr;

  //! One or two sentences for the reference page. Only tables may have none.
  std::string_view meaning;
  PageText page;
};

//! Returns the limits of a number: those of ShowKey::narrower for these settings, if it is set, or
//! else ShowKey::limits.
inline NumberLimits limits_of(const ShowKey& key, const void* settings) {
  return key.narrower != nullptr ? key.narrower(settings) : key.limits;
}

// Arguments for KeyOf::animated(): the parts of a rendering that an animation of the number
// invalidates, besides the picture itself.
inline constexpr NumberChange changes_stars{true, false, false};
inline constexpr NumberChange changes_sky{true, true, false};
inline constexpr NumberChange changes_exposure{false, false, true};

//! The keys of a table whose values are members of `Settings`.
template <class Settings>
struct KeyTable {
  std::span<const ShowKey> keys;
};

//! Builds the declaration of a key of `Settings`. The member functions below set what does not
//! follow from the type of the key's member.
template <class Settings>
struct KeyOf {
  ShowKey key;

  constexpr KeyOf range(double minimum, double maximum, std::string_view unit = "") {
    key.limits = {minimum, maximum};
    key.page.unit = unit;
    return *this;
  }
  //! Sets the range in degrees, as in the file; the struct's member is in radians.
  constexpr KeyOf degrees(double minimum, double maximum) {
    key.degrees = true;
    return range(minimum, maximum, "deg");
  }
  //! Sets a function that returns the range for given settings, if that is narrower than range().
  template <class Function>
  constexpr KeyOf range_in(Function /*function*/) {
    key.narrower = [](const void* settings) { return Function{}(*static_cast<const Settings*>(settings)); };
    return *this;
  }
  template <std::size_t Count>
  constexpr KeyOf words(const std::array<const char*, Count>& all) {
    key.words = all;
    return *this;
  }
  //! Sets the enumeration value of the first word; the default is 0.
  template <class Word>
  constexpr KeyOf first(Word word) {
    key.first_word = static_cast<std::int32_t>(word);
    return *this;
  }
  constexpr KeyOf animated(const NumberChange& change = {}) {
    key.changes = change;
    return *this;
  }
  constexpr KeyOf fixed(const char* reason) {
    key.fixed = reason;
    return *this;
  }
  constexpr KeyOf required(const char* remedy) {
    key.missing = remedy;
    return *this;
  }
  //! The key is allowed in files, and written, only if `function(settings)` returns true.
  template <class Function>
  constexpr KeyOf only_if(Function /*function*/) {
    key.applies = [](const void* settings) { return Function{}(*static_cast<const Settings*>(settings)); };
    return *this;
  }
  template <class Function>
  constexpr KeyOf written_if(Function /*function*/) {
    key.written = [](const void* settings) { return Function{}(*static_cast<const Settings*>(settings)); };
    return *this;
  }
  //! Calls `function(table, settings)` before the key is read, so that it can set a default that
  //! depends on other keys.
  template <class Function>
  constexpr KeyOf before(Function /*function*/) {
    key.before = [](TomlTable& table, void* settings) { Function{}(table, *static_cast<Settings*>(settings)); };
    return *this;
  }
  //! Calls `function(table, settings)` after the key was read, so that it can check the key against
  //! earlier keys of the table.
  template <class Function>
  constexpr KeyOf after(Function /*function*/) {
    key.after = [](TomlTable& table, void* settings) { Function{}(table, *static_cast<Settings*>(settings)); };
    return *this;
  }
  //! Reads the key with `read(table, settings)` instead of the default reader.
  template <class Read>
  constexpr KeyOf by(Read /*read*/) {
    key.read = [](TomlTable& table, void* settings) { Read{}(table, *static_cast<Settings*>(settings)); };
    return *this;
  }
  //! Reads the key with `read(table, settings)`, and writes it with `write(toml, settings)`,
  //! instead of the default functions.
  template <class Read, class Write>
  constexpr KeyOf by(Read read, Write /*write*/) {
    by(read);
    key.write = [](toml::table& table, const void* settings) {
      Write{}(table, *static_cast<const Settings*>(settings));
    };
    return *this;
  }
  //! Sets a function: the key is unused in a show if `function(show, settings)` returns a reason
  //! instead of nullptr.
  template <class Function>
  constexpr KeyOf unused_if(Function /*function*/) {
    key.unused = [](const Show& show, const void* settings) -> const char* {
      return Function{}(show, *static_cast<const Settings*>(settings));
    };
    return *this;
  }
  constexpr KeyOf page(PageText text) {
    if (text.unit.empty()) {
      text.unit = key.page.unit;
    }
    key.page = text;
    return *this;
  }
};

//! Derives the types of struct and member from a pointer to a member.
template <class Pointer>
struct MemberTypes;
template <class SettingsType, class ValueType>
struct MemberTypes<ValueType SettingsType::*> {
  using Settings = SettingsType;
  using Value = ValueType;
};

template <class Value>
inline constexpr bool is_optional = false;
template <class Value>
inline constexpr bool is_optional<std::optional<Value>> = true;
template <class Value>
inline constexpr bool is_vector = false;
template <class Value>
inline constexpr bool is_vector<std::vector<Value>> = true;

//! Returns the kind of a key by the type of its member.
template <class Value>
constexpr KeyKind kind_of() {
  if constexpr (is_optional<Value>) {
    return kind_of<typename Value::value_type>();
  } else if constexpr (std::is_same_v<Value, double>) {
    return KeyKind::number;
  } else if constexpr (std::is_same_v<Value, int>) {
    return KeyKind::integer;
  } else if constexpr (std::is_same_v<Value, bool>) {
    return KeyKind::boolean;
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return KeyKind::text;
  } else if constexpr (std::is_same_v<Value, LocalText>) {
    return KeyKind::local_text;
  } else if constexpr (std::is_enum_v<Value>) {
    static_assert(sizeof(Value) == sizeof(std::int32_t));
    return KeyKind::word;
  } else if constexpr (std::is_same_v<Value, std::array<double, 3>>) {
    return KeyKind::color;
  } else if constexpr (std::is_same_v<Value, Vector3<double>>) {
    return KeyKind::vector;
  } else if constexpr (is_vector<Value>) {
    return KeyKind::tables;
  } else {
    return KeyKind::table;
  }
}

//! Declares the key of a member (one pointer), or of a member of a member (several pointers).
template <auto First, auto... Rest>
constexpr auto key(std::string_view name, std::string_view meaning) {
  using Settings = typename MemberTypes<decltype(First)>::Settings;
  constexpr auto member = [](void* settings) -> auto& {
    return ((static_cast<Settings*>(settings)->*First).*....*Rest);
  };
  using Value = std::remove_reference_t<decltype(member(nullptr))>;
  KeyOf<Settings> made;
  made.key.name = name;
  made.key.meaning = meaning;
  made.key.kind = kind_of<Value>();
  made.key.at = [](void* settings, [[maybe_unused]] std::size_t i) -> void* {
    Value& value = decltype(member){}(settings);
    if constexpr (is_optional<Value>) {
      return value ? &*value : nullptr;
    } else if constexpr (is_vector<Value>) {
      return i < value.size() ? &value[i] : nullptr;
    } else {
      return &value;
    }
  };
  if constexpr (is_optional<Value>) {
    made.key.make = [](void* settings) -> void* { return &decltype(member){}(settings).emplace(); };
  } else if constexpr (is_vector<Value>) {
    made.key.make = [](void* settings) -> void* { return &decltype(member){}(settings).emplace_back(); };
  }
  return made;
}

//! Derives the struct of a table's keys from the type of a member, which may be an optional or a
//! vector of that struct.
template <class Value>
struct TableOf {
  using Type = Value;
};
template <class Value>
requires(is_optional<Value> || is_vector<Value>) struct TableOf<Value> {
  using Type = typename Value::value_type;
};

//! Declares the table of a member that is a struct, an optional struct or a vector of at most
//! `max_tables` structs.
template <auto Member, class Types = MemberTypes<decltype(Member)>>
constexpr KeyOf<typename Types::Settings> table(std::string_view name,
                                                KeyTable<typename TableOf<typename Types::Value>::Type> keys,
                                                std::string_view meaning = "", std::size_t max_tables = 0) {
  auto made = key<Member>(name, meaning);
  made.key.keys = keys.keys;
  made.key.max_tables = max_tables;
  return made;
}

//! Declares the keys of a member that is a struct, in the same table as the keys around it.
template <auto Member, class Types = MemberTypes<decltype(Member)>>
constexpr KeyOf<typename Types::Settings> part(KeyTable<typename Types::Value> keys) {
  auto made = key<Member>("", "");
  made.key.kind = KeyKind::part;
  made.key.keys = keys.keys;
  return made;
}

//! Declares a table whose keys are members of the same struct as the keys around it.
template <class Settings>
constexpr KeyOf<Settings> group(std::string_view name, KeyTable<Settings> keys, std::string_view meaning = "") {
  KeyOf<Settings> made;
  made.key.name = name;
  made.key.meaning = meaning;
  made.key.kind = KeyKind::table;
  made.key.keys = keys.keys;
  made.key.at = [](void* settings, std::size_t /*i*/) { return settings; };
  return made;
}

//! Declares a key that does not correspond to a single member; KeyOf::by() sets the functions that
//! read and write it.
template <class Settings>
constexpr KeyOf<Settings> other(std::string_view name, std::string_view meaning) {
  KeyOf<Settings> made;
  made.key.name = name;
  made.key.meaning = meaning;
  return made;
}

//! Returns the prefix of the paths of keys in a table: "sky.", for example. `path` is the prefix of
//! the table's own path ("" or "sky."); `i` is the entry if the table is in a list. Returns `path`
//! for KeyKind::part, which has no table of its own.
std::string path_below(const std::string& path, const ShowKey& key, std::size_t i);

//! The declarations of a table's keys, in the order in which they are read and documented.
template <class Settings, std::size_t Count>
struct KeyList {
  std::array<ShowKey, Count> keys;

  // NOLINTNEXTLINE(google-explicit-constructor): a list is used where its table is wanted
  constexpr operator KeyTable<Settings>() const { return {keys}; }
};

//! Returns the list of a struct's keys. Does not compile if a key belongs to another struct, a
//! numeric key has no range, a key of kind `word` has no list of allowed words, or a key that is
//! not a table has no explanation (ShowKey::meaning).
template <class Settings, class... Keys>
constexpr KeyList<Settings, sizeof...(Keys)> keys_of(const Keys&... keys) {
  static_assert((std::is_same_v<Keys, KeyOf<Settings>> && ...));
  const auto complete = [](const ShowKey& key) {
    const bool number = key.kind == KeyKind::number || key.kind == KeyKind::integer || key.kind == KeyKind::color ||
                        key.kind == KeyKind::vector;
    return (!number || key.limits.minimum < key.limits.maximum) && (key.kind != KeyKind::word || !key.words.empty()) &&
           (!key.keys.empty() || !key.meaning.empty());
  };
  if (!(complete(keys.key) && ...)) {
    throw std::logic_error("a key has no range, names or meaning");
  }
  return {{keys.key...}};
}

}  // namespace ergodome
