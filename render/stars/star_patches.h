#pragma once

#include <vector>

#include "content/lens_station.h"
#include "render/stars/patch_roots.h"
#include "render/stars/star_field.h"

namespace ergodome {

//! A part of a lens grid over which the lens is simple enough to be inverted.
struct StarPatch {
  BezierPatch sky;
  Vector3<double> axis;  //!< a cone about this holds all of it on the sky
  double sine;           //!< of the cone's half angle, and its cosine
  double cosine;
  float gamma_turns;  //!< its place in the chart
  float s;
  float width_turns;
  float height;
  PatchShape shape;
  float magnification;    //!< most of an image here, in the rain frame; where folded, but for 1e-9 sr of the sky
  float brightening;      //!< the observer's solid angles over the rain frame's, in the middle of the patch
  float frequency_ratio;  //!< g there, to the observer
};

//! An image of a star, roughly: where the grid has it.
struct RoughImage {
  int star;           //!< in the field
  float gamma_turns;  //!< in [0, 1)
  float s;
};

//! What the search for images asks about an observer and his stars.
class ImageLight {
 public:
  ImageLight() = default;
  virtual ~ImageLight() = default;
  ImageLight(const ImageLight&) = delete;
  ImageLight& operator=(const ImageLight&) = delete;

  //! Fills in `brightening` and `frequency_ratio`.
  virtual void see(StarPatch& patch) const = 0;

  //! The most that an image in a patch may be brighter than its star, when magnified so in the rain frame.
  [[nodiscard]] virtual float greatest_gain(const StarPatch& patch, float magnification) const = 0;

  //! The same for one star.
  [[nodiscard]] virtual float gain(const StarPatch& patch, float magnification, const FieldStar& star) const = 0;
};

//! A lens grid turned round: from places on the sky to places in the chart.
class StarPatches {
 public:
  //! Parts that gain less than `least_gain` are left out.
  StarPatches(const LensStation& station, const ImageLight& light, float least_gain);
  StarPatches(StarPatches&&) = default;
  StarPatches& operator=(StarPatches&&) = default;

  [[nodiscard]] const std::vector<StarPatch>& patches() const { return patches_; }

  //! Finds the images that a patch holds, of stars that may shine with at least `faintest` lx there. The camera is at `phi` [rad];
  //! `mirrored`: the other half of a mirrored grid. An image on a border may be found from both sides.
  void search(const StarPatch& patch, const StarField& field, const ImageLight& light, double phi, bool mirrored,
              float faintest, std::vector<RoughImage>& found) const;

  //! Whether the grid is half of a sky that is its own mirror image.
  [[nodiscard]] bool mirrored() const { return mirrored_; }

 private:
  void add_patch(const ImageLight& light, float least_gain, StarPatch patch, int depth);

  std::vector<float> edge_;  //!< of the chart
  LensChart chart_;
  bool mirrored_;
  std::vector<StarPatch> patches_;
};

}  // namespace ergodome
