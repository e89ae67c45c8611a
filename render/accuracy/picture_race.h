#pragma once

#include <functional>

#include "render/accuracy/lens_race.h"
#include "render/frame/show_renderer.h"

namespace ergodome {

//! A way to draw whole pictures of a show.
struct PictureChoice {
  std::string method;
  std::string setting;
  std::string published;
  Show show;
  LensChoice lens = LensChoice::automatic;
};

//! A picture that others are compared with, of the size of the moment's projection. It may render at another size and average.
using ReferencePicture = std::function<Picture(const AccuracyMoment& moment, const CameraPose& pose)>;

//! Measures ways to draw pictures: the difference of each compared pixel's luminance from the reference's, as a part of the mean of
//! what shines in the reference; its change from a frame to the next; times of a frame whose lens is there, in turn; and what the last of them spent its time on.
//!
//! Pixels that the shadow or the rim of the image covers in part are not compared.
std::vector<Measurement> measure_pictures(const std::vector<PictureChoice>& choices, const ReferencePicture& reference,
                                          const std::vector<AccuracyMoment>& moments, const AccuracySettings& settings,
                                          const AccuracyProgress& progress);

//! Mean of the pixels of a picture in blocks of `blocks` x `blocks`.
Picture averaged(const Picture& picture, int blocks);

//! The filters of the sky's map against the light summed exactly over parts of pixels.
AccuracyAxis measure_map(const Show& show, const AccuracySettings& settings, const AccuracyProgress& progress);

//! Whether frames take seconds without a GPU: they have objects, drawn by OpenGL. Fewer of them are then looked at.
inline bool draws_slowly(const Show& show) { return !show.objects.empty(); }

//! The same settings for pictures that are no wider.
AccuracySettings no_wider(AccuracySettings settings, const Show& show, int most_px);

//! What is asked of frames of a show that draws slowly: one moment, two rounds, small pictures. A lit object of 1024² pixels takes half a
//! minute by rays.
AccuracySettings paced(const AccuracySettings& settings, const Show& show);

//! Disk, shells and objects alone: by rays, and objects by the published polygons where those can draw them. The show has some.
AccuracyAxis measure_near(const Show& show, const AccuracySettings& settings, const AccuracyProgress& progress);

//! Whole frames as the show has them, by where their lens comes from.
AccuracyAxis measure_frames(const Show& show, const AccuracySettings& settings, const AccuracyProgress& progress);

}  // namespace ergodome
