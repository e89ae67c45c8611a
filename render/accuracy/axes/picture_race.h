#pragma once

#include <functional>

#include "render/accuracy/lenses/lens_race.h"
#include "render/frame/show_renderer.h"

// Measures methods by the whole pictures that they draw.

namespace ergodome {

//! A way to draw whole pictures of a show.
struct PictureChoice {
  std::string method;
  std::string setting;
  std::string published;
  Show show;
  LensChoice lens = LensChoice::automatic;
};

//! Renders the reference picture of a moment at a camera pose, with the size of the moment's
//! projection. May render at a larger size and average pixels.
using ReferencePicture = std::function<Picture(const AccuracyMoment& moment, const CameraPose& pose)>;

//! Measures ways to draw pictures: the difference of each compared pixel's luminance from the
//! reference, relative to the mean of the reference's lit pixels; the change of that difference
//! from frame to frame; times of frames whose lens is already prepared, drawn by all ways in turn;
//! and the cost of each pass in the last frame.
//!
//! Pixels with a coverage below 1 (in or at the shadow, or at the rim of the image) are not
//! compared, nor those that are dark in both pictures.
std::vector<Measurement> measure_pictures(const std::vector<PictureChoice>& choices, const ReferencePicture& reference,
                                          const std::vector<AccuracyMoment>& moments, const AccuracySettings& settings,
                                          const AccuracyProgress& progress);

//! Averages the pixels of a picture in blocks of `blocks` x `blocks`; drops incomplete blocks.
Picture averaged(const Picture& picture, int blocks);

//! Returns whether a show has objects: without a GPU, a frame with objects takes seconds, so fewer
//! such frames are measured.
inline bool draws_slowly(const Show& show) { return !show.objects.empty(); }

//! Returns the settings with the picture width limited to `max_px`.
AccuracySettings no_wider(AccuracySettings settings, const Show& show, int max_px);

//! Returns settings for a measurement; for shows that draw slowly they are reduced to one moment,
//! at most two rounds, and pictures at most 384 px wide. A lit object of 1024² pixels takes half a
//! minute with rays.
AccuracySettings paced(const AccuracySettings& settings, const Show& show);

}  // namespace ergodome
