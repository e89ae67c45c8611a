#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ergodome {

//! How a number, or the camera, leaves one key and arrives at the next.
//!
//! `smooth` rests at the first and the last key, and passes those between without a jolt (C²; content/key_curve.h). `in` leaves its key from
//! rest, `out` comes to rest at the next, `in_out` does both; the last way of all ends at full speed with `in`, the first begins so
//! with `out`. `linear` goes at one speed. `hold` stays, and jumps at the next key.
enum class Ease { smooth, linear, in, out, in_out, hold };
inline constexpr std::array ease_names = {"smooth", "linear", "in", "out", "in_out", "hold"};

//! The value of an animated number at one instant.
struct NumberKey {
  double time_s = 0.0;
  double value = 0.0;
  Ease ease = Ease::smooth;  //!< on the way from here to the next key
};

//! One number of the show that changes with time, in place of what its own key says.
struct Animation {
  std::string path;             //!< the number's place in the file: "hole.spin"
  std::vector<NumberKey> keys;  //!< in order of time, at least one
};

//! The same text in several languages, by their tags ("en", "de"); a text that has none stands under "".
using LocalText = std::map<std::string, std::string>;

//! A place to go to by name.
struct Chapter {
  double time_s = 0.0;
  LocalText title;
};

//! When something is there, and how it comes and goes.
struct Presence {
  double from_s = 0.0;
  double to_s = 0.0;
  double fade_in_s = 0.5;
  double fade_out_s = 0.5;
};

//! Where something stands on the dome, for a person who looks at its front. The view's tilt does not move it.
struct DomePlace {
  double azimuth_deg = 0.0;     //!< to the right of the front
  double elevation_deg = 20.0;  //!< above the horizon, of its middle
  double roll_deg = 0.0;        //!< clockwise

  bool operator==(const DomePlace&) const = default;
};

//! Words on the dome.
struct Caption {
  Presence presence;
  DomePlace place;
  double letter_deg = 2.0;                        //!< height of a line
  double width_deg = 60.0;                        //!< lines are broken here
  std::array<double, 3> color = {1.0, 1.0, 1.0};  //!< linear light, relative to white
  LocalText text;
};

//! An image over the picture: a flat one at a place, or a domemaster that covers all.
struct Overlay {
  std::string image;  //!< path relative to the show
  Presence presence;
  bool fisheye = false;
  DomePlace place;
  double width_deg = 30.0;  //!< of a flat one
  double fov_deg = 180.0;   //!< of a fisheye
  double opacity = 1.0;
};

//! Music or narration that starts at a time of the show.
struct AudioTrack {
  std::string file;  //!< path relative to the show
  double from_s = 0.0;
  double gain_db = 0.0;
  double fade_in_s = 0.0;
  double fade_out_s = 0.0;
  std::string language;  //!< narration that is heard in this language alone; empty: in all
  bool loop = false;
};

//! What a show does beside its camera.
struct Timeline {
  std::vector<Animation> animations;
  std::vector<Chapter> chapters;  //!< in order of time
  std::vector<Caption> captions;
  std::vector<Overlay> overlays;
  std::vector<AudioTrack> audio;
};

//! Tags of all languages that titles, captions and audio tracks have, in alphabetical order.
std::vector<std::string> languages(const Timeline& timeline);

//! The text in a language ("de-AT", then "de"); else the one that has none, else English, else the first
//! there is; empty where there is no text at all.
const std::string& text_in(const LocalText& text, std::string_view language);

}  // namespace ergodome
