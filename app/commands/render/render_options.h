#pragma once

#include <string>
#include <vector>

#include "app/cli/lens_options.h"
#include "app/cli/show_options.h"

namespace ergodome {

//! Options of `render`.
struct RenderOptions : ShowOverrides {
  std::string show;
  std::string out = "frames";
  std::string frames;
  std::string from;  //!< a time; renders frames from there on
  std::string to;    //!< a time; renders frames before it
  int size_px = 0;
  bool tint_eyes = false;
  bool from_outside = false;
  std::string backend = "auto";
  std::string format = "png";
  std::string compression;
  bool alpha = false;
  double frame_rate_hz = 0.0;
  std::string movie;
  bool delete_frames = false;  //!< deletes the frames after the film was checked
  std::string view = "sky";
  std::string view_range;  //!< range of a heat map's colors, "MIN:MAX"; empty: the default
  //! Channels to write instead of pictures, separated by commas; empty: none.
  std::string channels;
  std::string method;
  std::string setup;
  std::string language;  //!< language tag of captions, readout, title and narration
  LensOptions lens;
  bool resume = false;
  bool verify = false;      //!< checks frames and renders none
  bool no_summary = false;  //!< writes no metadata summary of the frames
  std::string meter;        //!< folder to which the frames' light is written, instead of frames
  std::string light;        //!< folder of such light, from which automatic exposure is followed
  std::string pattern;
  std::vector<std::string> budget;  //!< words of --budget
  //! Number of show times at which the error is checked against the budget, instead of writing
  //! frames; 0: none.
  int checked_moments = 0;
};

}  // namespace ergodome
