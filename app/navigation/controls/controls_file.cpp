#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "app/navigation/controls/controls.h"
#include "app/navigation/controls/steer_binding.h"
#include "content/files/atomic_file.h"
#include "content/files/toml_table.h"

namespace ergodome {

namespace {

constexpr std::size_t largest_mib = 1;
constexpr std::size_t max_inputs = 32;

//! An input with the key that binds it, for messages.
struct Use {
  Input input;
  std::string location;  //!< "actions.pause"
  bool steers = false;
};

//! Returns whether two uses conflict: the same input, or a steering key that an action uses with
//! Shift.
bool clash(const Use& a, const Use& b) {
  if (a.input == b.input) {
    return true;
  }
  const auto shifted = [](const Use& steering, const Use& action) {
    Input with_shift = steering.input;
    with_shift.modifiers |= shift_held;
    return steering.steers && steering.input.kind == Input::Kind::key && with_shift == action.input;
  };
  return a.steers != b.steers && (shifted(a, b) || shifted(b, a));
}

//! Returns the error about a name in a list that is unknown, or that the list does not accept. For
//! an unknown name, it suggests the closest known one.
Error unknown(const TomlTable& table, std::string_view key, const std::string& text) {
  const std::string bare = text.substr(std::min(text.size(), text.find_last_of("*+-") + 1));
  const std::vector<std::string>& names = input_names();
  if (std::ranges::find(names, bare) != names.end()) {
    return table.error_at(
        key, fmt::format("contains \"{}\", which cannot be used here", text.substr(0, 60)),
        "only [steer] accepts signs and factors (up to 100), only [actions] accepts wheel.up and wheel.down");
  }
  const std::string nearest = nearest_word(bare, names);
  return table.error_at(
      key, fmt::format("contains \"{}\", which is not an input", text.substr(0, 60)),
      nearest.empty()
          ? "write names such as \"Space\", \"Ctrl+R\" or \"pad.south\"; see reference/controls.md in the documentation"
          : fmt::format("did you mean \"{}\"?", nearest));
}

//! Returns the texts of a list, or a single text.
std::vector<std::string> texts_at(TomlTable& table, std::string_view key) {
  const toml::node* node = table.node(key);
  std::vector<std::string> texts;
  if (const auto single = node->value_exact<std::string>()) {
    texts.push_back(*single);
    return texts;
  }
  const toml::array* list = node->as_array();
  if (list == nullptr || list->size() > max_inputs) {
    throw table.error_at(key, "is not a list of inputs",
                         "write for example [\"Space\", \"pad.start\"], or [] for no input");
  }
  for (const toml::node& item : *list) {
    const auto text = item.value_exact<std::string>();
    if (!text) {
      throw table.error_at(key, "contains a value that is not text", "write names of inputs in quotes");
    }
    texts.push_back(*text);
  }
  return texts;
}

//! Records an input that the file binds; throws Error if the file already binds it.
void note(const TomlTable& table, std::string_view key, const Input& input, bool steers, std::vector<Use>& uses) {
  Use use = {input, table.path_of(key), steers};
  const auto before = std::ranges::find_if(uses, [&](const Use& other) { return clash(use, other); });
  if (before != uses.end()) {
    throw table.error_at(key, fmt::format("binds {}, which is already bound to {}", name_of(input), before->location),
                         "choose another input");
  }
  uses.push_back(std::move(use));
}

void check_action_input(const TomlTable& table, std::string_view key, const Input& input) {
  if (input.kind == Input::Kind::pad_axis || input.kind == Input::Kind::mouse_axis ||
      input.kind == Input::Kind::wheel) {
    throw table.error_at(key, fmt::format("binds {}, an axis, which cannot trigger an action", name_of(input)),
                         "move it to [steer], or bind a key or a button");
  }
}

//! Reads and records the inputs of an action.
std::vector<Input> action_inputs(TomlTable& table, std::string_view key, std::vector<Use>& uses) {
  std::vector<Input> inputs;
  for (const std::string& name : texts_at(table, key)) {
    const auto input = input_of(name);
    if (!input) {
      throw unknown(table, key, name);
    }
    check_action_input(table, key, *input);
    note(table, key, *input, false, uses);
    inputs.push_back(*input);
  }
  return inputs;
}

//! Reads and records the inputs of a steering component.
std::vector<Controls::SteerBinding> steer_inputs(TomlTable& table, std::string_view key, std::vector<Use>& uses) {
  std::vector<Controls::SteerBinding> bindings;
  for (const std::string& name : texts_at(table, key)) {
    const auto binding = steer_binding_of(name);
    if (!binding) {
      throw unknown(table, key, name);
    }
    note(table, key, binding->input, true, uses);
    bindings.push_back(*binding);
  }
  return bindings;
}

std::string list_of(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) {
    list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", text);
  }
  return fmt::format("[{}]", list);
}

}  // namespace

Controls parse_controls(std::string_view text, const std::string& file) {
  const toml::table parsed = parse_toml(text, file, largest_mib, "a controls file");
  TomlTable root(parsed, file, "");
  const toml::table empty;
  const toml::table* actions_at = root.table("actions");
  const toml::table* steer_at = root.table("steer");
  root.refuse_unknown_keys();
  TomlTable actions(actions_at != nullptr ? *actions_at : empty, file, "actions");
  TomlTable steer(steer_at != nullptr ? *steer_at : empty, file, "steer");
  std::map<KeyAction, std::vector<Input>> own_actions;
  std::map<std::size_t, std::vector<Controls::SteerBinding>> own_steering;
  std::vector<Use> uses;
  for (const ActionNames& named : all_actions()) {
    if (actions.node(named.name) != nullptr) {
      own_actions[named.action] = action_inputs(actions, named.name, uses);
    }
  }
  for (std::size_t i = 0; i < all_steering().size(); ++i) {
    if (steer.node(all_steering()[i].name) != nullptr) {
      own_steering[i] = steer_inputs(steer, all_steering()[i].name, uses);
    }
  }
  actions.refuse_unknown_keys();
  steer.refuse_unknown_keys();
  // Inputs that the file binds are removed from all default bindings. Actions and steering that the
  // file lists then get exactly the inputs listed there.
  const auto taken = [&](const Input& input, bool steers) {
    return std::ranges::any_of(uses, [&](const Use& use) { return clash({input, {}, steers}, use); });
  };
  Controls controls;
  for (auto& [action, inputs] : controls.actions_) {
    std::erase_if(inputs, [&](const Input& input) { return taken(input, false); });
  }
  for (auto& bindings : controls.steering_) {
    std::erase_if(bindings, [&](const Controls::SteerBinding& b) { return taken(b.input, true); });
  }
  for (auto& [action, inputs] : own_actions) {
    controls.actions_[action] = std::move(inputs);
  }
  for (auto& [location, bindings] : own_steering) {
    controls.steering_[location] = std::move(bindings);
  }
  return controls;
}

Controls read_controls(const std::filesystem::path& path) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem) ||
      std::filesystem::file_size(path, problem) > (largest_mib << 20U) || problem) {
    throw Error(path.string(), "is not a readable controls file", "give the path of a TOML file of at most 1 MiB");
  }
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  if (!file) {
    throw Error(path.string(), "cannot be read", "check its permissions");
  }
  return parse_controls(text.str(), path.string());
}

std::filesystem::path own_controls_path() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && *config == '/') {
    return std::filesystem::path(config) / "ergodome" / "controls.toml";
  }
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home == '/') {
    return std::filesystem::path(home) / ".config" / "ergodome" / "controls.toml";
  }
  return {};
}

Controls load_controls(const std::filesystem::path& chosen) {
  if (!chosen.empty()) {
    return read_controls(chosen);
  }
  const std::filesystem::path own = own_controls_path();
  std::error_code problem;
  return !own.empty() && std::filesystem::exists(own, problem) ? read_controls(own) : Controls();
}

std::string to_toml(const Controls& controls) {
  std::string text =
      "# Assigns keys, mouse and pads to actions. Actions that are not listed keep their default inputs; [] means no "
      "input.\n"
      "# Examples of inputs: \"Space\", \"Ctrl+R\", \"mouse.left\", \"wheel.up\", \"pad.south\", \"pad.left_x\" "
      "...\n\n[actions]\n";
  for (const ActionNames& named : all_actions()) {
    std::vector<std::string> names;
    for (const Input& input : controls.inputs_of(named.action)) {
      names.push_back(name_of(input));
    }
    text += fmt::format("{} = {}  # {}\n", named.name, list_of(names), named.english);
  }
  text += "\n# A minus sign reverses an input, a factor scales it: \"-A\", \"0.5*pad.left_x\".\n[steer]\n";
  for (const SteerNames& named : all_steering()) {
    std::vector<std::string> names;
    for (const Controls::SteerBinding& binding : controls.inputs_of(named.component)) {
      names.push_back(text_of(binding));
    }
    text += fmt::format("{} = {}  # {}\n", named.name, list_of(names), named.english);
  }
  return text;
}

void write_default_controls(const std::filesystem::path& path) {
  std::error_code problem;
  if (std::filesystem::exists(path, problem)) {
    throw Error(path.string(), "already exists", "choose another name, or remove the file first");
  }
  write_text_atomically(path, to_toml(Controls()));
}

}  // namespace ergodome
