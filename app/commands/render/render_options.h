#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/cli/lens_options.h"

namespace ergodome {

//! What a person asks of `render`.
struct RenderOptions {
  std::string show;
  ShowSettings set;  //!< keys of the show that --set changes
  std::string out = "frames";
  std::string frames;
  std::string from;  //!< a time; frames from there on
  std::string to;    //!< a time; frames before that
  int size_px = 0;
  std::string projection;
  std::string objects;
  std::string stereo;
  std::optional<double> tilt_deg;
  std::optional<double> baseline;
  bool tint_eyes = false;
  bool from_outside = false;
  std::string backend = "auto";
  std::string format = "png";
  std::string compression;
  bool alpha = false;
  double frame_rate_hz = 0.0;
  std::string movie;
  bool delete_frames = false;  //!< once the film of them is checked
  std::string view = "sky";
  std::string view_range;  //!< ends of a heat map's colours, "MIN:MAX"; empty: as usual
  std::string channels;    //!< numbers to write instead of pictures, separated by commas; empty: pictures
  std::string method;
  std::string setup;
  std::string language;  //!< of captions, by its tag
  LensOptions lens;
  bool resume = false;
  std::string pattern;
  std::vector<std::string> budget;  //!< words of --budget
  int checked_moments = 0;          //!< at which the budget is checked, in place of writing frames; 0: none
};

}  // namespace ergodome
