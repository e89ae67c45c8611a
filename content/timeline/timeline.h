#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ergodome {

//! How an animated number or the camera leaves one key and arrives at the next.
//!
//! `smooth` rests at the first and the last key, and passes inner keys with continuous second
//! derivatives (C²; content/timeline/key_curve.h). `in` starts from rest, `out` comes to rest at the
//! next key, `in_out` does both. The last span ends at full speed with `in`, and the first one
//! begins at full speed with `out`. `linear` has constant speed. `hold` stays, and jumps at the
//! next key.
enum class Ease { smooth, linear, in, out, in_out, hold };
inline constexpr std::array ease_names = {"smooth", "linear", "in", "out", "in_out", "hold"};

//! Minimum distance of two keys of a number, or of the camera [s].
inline constexpr double min_key_gap_s = 1e-6;

//! The value of an animated number at one instant.
struct NumberKey {
  double time_s = 0.0;
  double value = 0.0;
  Ease ease = Ease::smooth;  //!< easing on the way from this key to the next
};

//! A number of the show that changes with time, in place of its fixed value.
struct Animation {
  std::string path;             //!< path of the number in the file: "hole.spin"
  std::vector<NumberKey> keys;  //!< in order of time, at least one
};

//! A text in several languages, by their tags ("en", "de"); a text without a language has the tag
//! "".
using LocalText = std::map<std::string, std::string>;

//! A named time of the show to jump to.
struct Chapter {
  double time_s = 0.0;
  LocalText title;
};

//! When something is visible, and how it fades in and out.
struct Presence {
  double from_s = 0.0;
  double to_s = 0.0;
  double fade_in_s = 0.5;
  double fade_out_s = 0.5;
};

//! Position on the dome for a viewer who faces the dome's front. The view's tilt does not move it.
struct DomePosition {
  double azimuth_deg = 0.0;     //!< azimuth to the right of the front
  double elevation_deg = 20.0;  //!< elevation of the center above the horizon
  double roll_deg = 0.0;        //!< clockwise rotation

  bool operator==(const DomePosition&) const = default;
};

//! A text on the dome.
struct Caption {
  Presence presence;
  DomePosition position;
  double letter_deg = 2.0;                        //!< height of a line
  double width_deg = 60.0;                        //!< maximum width of lines
  std::array<double, 3> color = {1.0, 1.0, 1.0};  //!< linear light, relative to white
  LocalText text;
};

//! An image over the rendering: a flat one at a position, or a domemaster that covers everything.
struct Overlay {
  std::string image;  //!< path relative to the show
  Presence presence;
  bool fisheye = false;
  DomePosition position;
  double width_deg = 30.0;  //!< width of a flat image
  double fov_deg = 180.0;   //!< field of view of a fisheye image
  double opacity = 1.0;
};

//! Music or narration that starts at a time of the show.
struct AudioTrack {
  std::string file;  //!< path relative to the show
  double from_s = 0.0;
  double gain_db = 0.0;
  double fade_in_s = 0.0;
  double fade_out_s = 0.0;
  std::string language;  //!< language of a narration, played only in this language; empty: in all
  bool loop = false;
};

//! The contents of a show besides its scene and camera: animations, chapters, captions, overlays
//! and sound.
struct Timeline {
  std::vector<Animation> animations;
  std::vector<Chapter> chapters;  //!< in order of time
  std::vector<Caption> captions;
  std::vector<Overlay> overlays;
  std::vector<AudioTrack> audio;
};

//! Returns the language tags of all chapter titles, captions and audio tracks, in alphabetical
//! order.
std::vector<std::string> languages(const Timeline& timeline);

//! Returns the text in a language ("de-AT", then "de"); else the one without a language, else
//! English, else the first one; empty if there is no text at all.
const std::string& text_in(const LocalText& text, std::string_view language);

}  // namespace ergodome
