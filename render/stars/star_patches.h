#pragma once

#include <vector>

#include "content/lens_station.h"
#include "kernels/stars/patch_measure.h"
#include "render/stars/bezier_patch.h"
#include "render/stars/mended_grid.h"
#include "render/stars/star_field.h"

namespace ergodome {

//! What light becomes for an observer, at the most: stars are so much brighter, times their magnification in the rain frame and what their
//! class gains in that row of ShiftGains.
struct PatchLight {
  float brighter;
  int shift_row;
};

//! A part of a lens grid over which the lens is simple enough to be inverted.
struct StarPatch {
  BezierPatch sky;  //!< in its frame
  PatchFrame frame;
  SkyPart part;       //!< holds all of it on the sky
  float gamma_turns;  //!< its place in the chart
  float s;
  float width_turns;
  float height;
  PatchShape shape;
  int leaf;        //!< whose part it is
  float brighter;  //!< what an image in it may be brighter by than the grid makes it out to be, as a factor
  bool exact;      //!< images in it, mended, need no rays, where it is not folded
  float error;     //!< how far it may be from the sky where that matters, next to critical curves [rad]
  int halvings;    //!< that its search for images takes, where it is not regular
  PatchLight light;
  Vector3<float> seen;  //!< the way to it in the observer's frame
  float seen_radius;    //!< of a cone about that way that holds it [rad]
  float most_camera;    //!< most that the rain frame's camera sees of it per unit of its own (u, v) [sr]
  float magnification;  //!< the most in it, in the rain frame; where folded, but for 1e-8 sr of the sky
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

  //! What light becomes in a patch where the observer's solid angles are at the most `brightening` times the rain frame's, and g is at the
  //! most `frequency_ratio`.
  [[nodiscard]] virtual PatchLight light_in(float brightening, float frequency_ratio) const = 0;
};

//! How exact a grid is that is turned round.
struct GridExactness {
  double pixel;       //!< of the screen that its errors are told for [rad]
  double fold_error;  //!< next to critical curves, on the camera's sky [rad]
};

//! Where the mended grid is nearer than this to the sky, images are where it has them [px].
inline constexpr float exact_grid_px = 0.008F;

//! A lens grid turned round: from places on the sky to places in the chart.
class StarPatches {
 public:
  //! For images of at least `faintest` lx: the more stars may have some, the finer. Where `station` was not built to be
  //! inverted (GridSettings), all of them need rays.
  StarPatches(const LensStation& station, const StarField& field, const ImageLight& light, float faintest,
              const GridExactness& exactness);
  StarPatches(StarPatches&&) = default;
  StarPatches& operator=(StarPatches&&) = default;

  [[nodiscard]] const std::vector<StarPatch>& patches() const { return patches_; }

  //! Whether the grid is half of a sky that is its own mirror image.
  [[nodiscard]] bool mirrored() const { return mirrored_; }

  //! Illuminance below which images are left out [lx].
  [[nodiscard]] float faintest() const { return faintest_; }

  //! Moves images to where rays have them.
  [[nodiscard]] const MendedGrid& mended() const { return mended_; }

  //! Which stars may have images in a patch that are bright enough.
  [[nodiscard]] StarFloor floor_of(const StarPatch& patch) const {
    return {faintest_ / (patch.light.brighter * patch.magnification), patch.light.shift_row};
  }

 private:
  //! What making patches asks for.
  struct Wanted {
    const StarField& field;
    const ImageLight& light;
  };

  void add_patch(const Wanted& wanted, const StarPatch& patch, int depth, std::vector<StarPatch>& patches) const;
  [[nodiscard]] bool is_done(const Wanted& wanted, const StarPatch& patch, const SkyFrustum& frustum) const;
  void tell_error(float error_px, StarPatch& patch) const;

  MendedGrid mended_;
  std::vector<float> edge_;  //!< of the chart
  LensChart chart_;
  bool mirrored_;
  float faintest_;
  GridExactness exactness_;
  std::vector<StarPatch> patches_;
};

}  // namespace ergodome
