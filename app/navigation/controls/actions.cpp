#include "app/navigation/controls/actions.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

namespace {

using enum KeyAction;
constexpr ActionUser visitor = ActionUser::visitor;
constexpr ActionUser presenter = ActionUser::presenter;

constexpr ActionNames actions[] = {
    {help, "help", visitor, "F1 pad.select", "this help", "diese Hilfe"},
    {pause, "pause", visitor, "Space pad.start", "pause, resume", "anhalten, weiter"},
    {seek_back, "seek_back", presenter, "Left", "back 2 s", "2 s zurück"},
    {seek_forward, "seek_forward", presenter, "Right", "forward 2 s", "2 s vor"},
    {previous_chapter, "previous_chapter", presenter, "PageUp", "previous chapter", "voriges Kapitel"},
    {next_chapter, "next_chapter", presenter, "PageDown", "next chapter", "nächstes Kapitel"},
    {fly, "fly", visitor, "Tab pad.south", "free flight, back to the show", "freier Flug, zurück zur Vorführung"},
    {return_to_path, "return_to_path", visitor, "P pad.east", "fly back to the show's path",
     "zurück auf den Weg der Vorführung"},
    {reset, "reset", visitor, "Delete pad.right_stick", "reset camera and picture", "Kamera und Bild zurücksetzen"},
    {next_flight_mode, "next_flight_mode", visitor, "N pad.west", "next flight mode: orbit, ship, hover, free fall",
     "nächste Flugart: Umkreisen, Schiff, Schweben, freier Fall"},
    {next_observer, "next_observer", visitor, "U pad.north", "next observer", "nächster Beobachter"},
    {reverse_orbit, "reverse_orbit", visitor, "Ctrl+N pad.left_stick", "reverse the orbit", "Umlaufrichtung umkehren"},
    {let_go, "let_go", visitor, "K pad.left_trigger_button", "let go: fall into the hole",
     "loslassen: ins Loch fallen"},
    {next_language, "next_language", visitor, "G pad.guide", "next language", "nächste Sprache"},
    {step_back, "step_back", presenter, "Ctrl+Left", "one frame back", "ein Bild zurück"},
    {step_forward, "step_forward", presenter, "Ctrl+Right", "one frame forward", "ein Bild vor"},
    {slower, "slower", presenter, "Down", "half the speed", "halbe Geschwindigkeit"},
    {faster, "faster", presenter, "Up", "double the speed", "doppelte Geschwindigkeit"},
    {usual_speed, "usual_speed", presenter, "Ctrl+Down", "normal speed", "normale Geschwindigkeit"},
    {reverse, "reverse", presenter, "Ctrl+Up", "play backward, forward", "rückwärts, vorwärts"},
    {restart, "restart", presenter, "Home", "to the start of the show", "an den Anfang der Vorführung"},
    {loop, "loop", presenter, "O", "loop on, off", "Schleife an, aus"},
    {blackout, "blackout", presenter, "B", "blackout on, off", "Blackout an, aus"},
    {captions, "captions", presenter, "C", "captions on, off", "Untertitel an, aus"},
    {volume_down, "volume_down", presenter, "F6", "quieter", "leiser"},
    {volume_up, "volume_up", presenter, "F7", "louder", "lauter"},
    {exposure_down, "exposure_down", presenter, "F2", "darker by half a stop", "eine halbe Blende dunkler"},
    {exposure_up, "exposure_up", presenter, "F3", "brighter by half a stop", "eine halbe Blende heller"},
    {exposure_reset, "exposure_reset", presenter, "F4", "reset exposure", "Belichtung zurücksetzen"},
    {reload, "reload", presenter, "Ctrl+R", "reload the show file", "Vorführung neu laden"},
    {full_screen, "full_screen", presenter, "F11", "full screen on, off", "Vollbild an, aus"},
    {next_view, "next_view", presenter, "V", "next view: sky, steps, error, order, g, magnification",
     "nächste Ansicht: Himmel, Schritte, Fehler, Ordnung, g, Vergrößerung"},
    {times, "times", presenter, "I", "show frame time and lens", "Bildzeit und Linse anzeigen"},
    {baseline_smaller, "baseline_smaller", presenter, "LeftBracket", "smaller stereo baseline", "kleinere Stereobasis"},
    {baseline_larger, "baseline_larger", presenter, "RightBracket", "larger stereo baseline", "größere Stereobasis"},
    {baseline_reset, "baseline_reset", presenter, "Backspace", "reset the baseline", "Stereobasis zurücksetzen"},
    {convergence_nearer, "convergence_nearer", presenter, "Comma", "converge nearer", "Konvergenz näher"},
    {convergence_farther, "convergence_farther", presenter, "Period", "converge farther, then at infinity",
     "Konvergenz ferner, dann im Unendlichen"},
    {swap_eyes, "swap_eyes", presenter, "X", "swap left and right eye", "Augen vertauschen"},
    {tint_eyes, "tint_eyes", presenter, "T", "tint the eyes: left reddish, right cyan",
     "Augen färben: links rötlich, rechts cyan"},
    {next_layout, "next_layout", presenter, "L", "next stereo layout", "nächste Stereo-Anordnung"},
    {next_model, "next_model", presenter, "M", "next stereo model: physical, flat, omni",
     "nächstes Stereo-Modell: physical, flat, omni"},
    {leave_exhibit, "leave_exhibit", presenter, "Ctrl+Alt+Q", "leave the exhibit: hold for 3 s",
     "Ausstellung verlassen: 3 s halten"},
    {quit, "quit", presenter, "Escape", "quit", "beenden"},
};

constexpr SteerNames steering[] = {
    {&Steering::right, "right", "D -A pad.left_x pad.move_right", "move right, left", "nach rechts, links"},
    {&Steering::up, "up", "R -F pad.right_shoulder -pad.left_shoulder pad.move_up", "move up, down",
     "nach oben, unten"},
    {&Steering::forward, "forward", "W -S pad.left_y pad.move_forward", "move forward, back", "vorwärts, zurück"},
    {&Steering::yaw, "yaw", "Shift+Right -Shift+Left Keypad6 -Keypad4 -mouse.x pad.right_x pad.turn_yaw",
     "look right, left", "nach rechts, links schauen"},
    {&Steering::pitch, "pitch", "Shift+Up -Shift+Down Keypad8 -Keypad2 mouse.y pad.right_y pad.turn_pitch",
     "look up, down", "nach oben, unten schauen"},
    {&Steering::roll, "roll", "E -Q pad.dpad_right -pad.dpad_left pad.turn_roll", "roll right, left",
     "nach rechts, links neigen"},
    {&Steering::zoom, "zoom", "Equal -Minus wheel pad.dpad_up -pad.dpad_down", "zoom in, out", "Zoom: näher, weiter"},
    {&Steering::faster, "faster", "LeftShift pad.right_trigger", "move faster", "schneller bewegen"},
};

//! Multiplies a speed by a factor and keeps its sign. Limits its magnitude to 1/16 to 16 times the
//! normal speed; doubling 0 gives 1/16. A speed that a command has set outside these limits is not
//! moved in the opposite direction.
double changed_speed(double speed, double factor) {
  constexpr double minimum = 1.0 / 16.0;
  constexpr double maximum = 16.0;
  const double now = std::abs(speed);
  const double from = now == 0.0 && factor > 1.0 ? 0.5 * minimum : now;
  const double size = std::clamp(factor * from, std::min(from, minimum), std::max(from, maximum));
  return std::copysign(size, speed);
}

}  // namespace

std::span<const ActionNames> all_actions() { return actions; }
std::span<const SteerNames> all_steering() { return steering; }

std::optional<TransportCommand> transport_command(KeyAction action, const PlayerStatus& status) {
  using Kind = TransportCommand::Kind;
  constexpr double seek_s = 2.0;
  constexpr double stop = 0.5;
  switch (action) {
    case pause:
      return TransportCommand{Kind::toggle_pause, 0.0, {}};
    case seek_back:
      return TransportCommand{Kind::seek_by, -seek_s, {}};
    case seek_forward:
      return TransportCommand{Kind::seek_by, seek_s, {}};
    case step_back:
      return TransportCommand{Kind::step, -1.0, {}};
    case step_forward:
      return TransportCommand{Kind::step, 1.0, {}};
    case slower:
      return TransportCommand{Kind::speed, changed_speed(status.speed, 0.5), {}};
    case faster:
      return TransportCommand{Kind::speed, changed_speed(status.speed, 2.0), {}};
    case usual_speed:
      return TransportCommand{Kind::speed, 1.0, {}};
    case reverse:
      return TransportCommand{Kind::speed, -status.speed, {}};
    case restart:
      return TransportCommand{Kind::seek, 0.0, {}};
    case previous_chapter:
      return TransportCommand{Kind::previous_chapter, 0.0, {}};
    case next_chapter:
      return TransportCommand{Kind::next_chapter, 0.0, {}};
    case loop:
      return TransportCommand{Kind::loop, status.loop ? 0.0 : 1.0, {}};
    case blackout:
      return TransportCommand{Kind::toggle_blackout, 0.0, {}};
    case next_language:
      return TransportCommand{Kind::next_language, 0.0, {}};
    case volume_down:
      return TransportCommand{Kind::volume, std::max(status.volume - 0.1, 0.0), {}};
    case volume_up:
      return TransportCommand{Kind::volume, std::min(status.volume + 0.1, 1.0), {}};
    case exposure_down:
      return TransportCommand{Kind::exposure, status.exposure_stops - stop, {}};
    case exposure_up:
      return TransportCommand{Kind::exposure, status.exposure_stops + stop, {}};
    case exposure_reset:
      return TransportCommand{Kind::exposure, 0.0, {}};
    case fly:
      return TransportCommand{status.free_flight ? Kind::return_to_path : Kind::free_flight, 0.0, {}};
    case return_to_path:
      return TransportCommand{Kind::return_to_path, 0.0, {}};
    case reset:
      return TransportCommand{Kind::reset, 0.0, {}};
    case reload:
      return TransportCommand{Kind::reload, 0.0, {}};
    default:
      return std::nullopt;
  }
}

}  // namespace ergodome
