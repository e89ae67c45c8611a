#include "app/player_keys.h"

#include "app/navigation/controls.h"

namespace ergodome {

namespace {

const Controls& own_controls() {
  static const Controls controls;
  return controls;
}

}  // namespace

KeyAction action_of(int key) {
  const std::vector<KeyAction> actions = own_controls().pressed(key, {key});
  if (!actions.empty()) {
    return actions.front();
  }
  const Steering steering = own_controls().steering({key}, {}, {}).rates;
  const auto chosen = [](double rate, KeyAction positive, KeyAction negative) {
    return rate > 0.0 ? positive : rate < 0.0 ? negative : KeyAction::none;
  };
  for (const KeyAction action :
       {chosen(steering.right, KeyAction::right, KeyAction::left), chosen(steering.up, KeyAction::up, KeyAction::down),
        chosen(steering.forward, KeyAction::in, KeyAction::out)}) {
    if (action != KeyAction::none) {
      return action;
    }
  }
  return KeyAction::none;
}

std::string key_help() {
  std::string text = "Keys:\n";
  const std::string lines = own_controls().help_text({.pads = false});
  for (std::size_t from = 0; from < lines.size();) {
    const std::size_t end = lines.find('\n', from);
    text.append("  ").append(lines, from, end + 1 - from);
    from = end + 1;
  }
  text.pop_back();
  return text;
}

}  // namespace ergodome
