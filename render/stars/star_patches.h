#pragma once

#include <vector>

#include "content/lens_station.h"
#include "kernels/stars/patch_measure.h"
#include "render/stars/bezier_patch.h"
#include "render/stars/star_field.h"

namespace ergodome {

//! A part of a lens grid over which the lens is simple enough to be inverted.
struct StarPatch {
  BezierPatch sky;  //!< in its frame
  PatchFrame frame;
  SkyFrustum frustum;  //!< holds all of it on the sky
  SkyBounds bounds;    //!< of that
  float gamma_turns;   //!< its place in the chart
  float s;
  float width_turns;
  float height;
  PatchShape shape;
  float brighter;         //!< what an image in it may be brighter by than the grid makes it out to be, as a factor
  bool exact;             //!< images in it need no rays, where it is not folded
  float error;            //!< how far it may be from the sky where that matters, next to critical curves [rad]
  int halvings;           //!< that its search for images takes, where it is not regular
  float brightening;      //!< the observer's solid angles over the rain frame's, in the middle of the patch
  float frequency_ratio;  //!< g there, to the observer
  Vector3<float> seen;    //!< the way to it in the observer's frame
  float seen_radius;      //!< of a cone about that way that holds it [rad]
  float most_camera;      //!< most that the rain frame's camera sees of it per unit of its own (u, v) [sr]
  float gain;  //!< most that an image here may be brighter than its star; where folded, but for 1e-8 sr of the sky
};

//! What the search for images asks about an observer and his stars.
class ImageLight {
 public:
  ImageLight() = default;
  virtual ~ImageLight() = default;
  ImageLight(const ImageLight&) = delete;
  ImageLight& operator=(const ImageLight&) = delete;

  //! The observer's frame, and the energy at infinity of light from rain-frame directions.
  [[nodiscard]] virtual AberrationOf<float> observer() const = 0;
  [[nodiscard]] virtual DirectionForm<float> energy() const = 0;

  //! The most that an image in a patch may be brighter than its star, when magnified so in the rain frame.
  [[nodiscard]] virtual float greatest_gain(const StarPatch& patch, float magnification) const = 0;

  //! The same for one star.
  [[nodiscard]] virtual float gain(const StarPatch& patch, float magnification, const FieldStar& star) const = 0;
};

//! How exact a grid is that is turned round.
struct GridExactness {
  double pixel;       //!< of the screen that its errors are told for [rad]
  double fold_error;  //!< next to critical curves, on the camera's sky [rad]
};

//! Where the grid is nearer than this to the sky, at its check points, images are where it has them [px].
inline constexpr double exact_grid_px = 0.008;

//! A lens grid turned round: from places on the sky to places in the chart.
class StarPatches {
 public:
  //! For images of at least `faintest` lx: the more stars may have some, the finer. `station` was built, not blended: it knows its leaves'
  //! errors.
  StarPatches(const LensStation& station, const StarField& field, const ImageLight& light, float faintest,
              const GridExactness& exactness);
  StarPatches(StarPatches&&) = default;
  StarPatches& operator=(StarPatches&&) = default;

  [[nodiscard]] const std::vector<StarPatch>& patches() const { return patches_; }

  //! Whether the grid is half of a sky that is its own mirror image.
  [[nodiscard]] bool mirrored() const { return mirrored_; }

  //! Illuminance below which images are left out [lx].
  [[nodiscard]] float faintest() const { return faintest_; }

 private:
  //! What making patches asks for.
  struct Wanted {
    const StarField& field;
    const ImageLight& light;
  };

  void add_patch(const Wanted& wanted, const StarPatch& patch, int depth, std::vector<StarPatch>& patches) const;
  [[nodiscard]] bool is_done(const Wanted& wanted, const StarPatch& patch) const;
  void tell_error(const LeafBox& box, float error_px, StarPatch& patch) const;

  std::vector<float> edge_;  //!< of the chart
  LensChart chart_;
  bool mirrored_;
  float faintest_;
  GridExactness exactness_;
  std::vector<StarPatch> patches_;
};

}  // namespace ergodome
