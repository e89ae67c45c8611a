#pragma once

#include <utility>
#include <vector>

#include "content/trajectory/lens_station.h"
#include "kernels/stars/search/patch_measure.h"
#include "kernels/stars/search/star_patch.h"
#include "render/passes/stars/search/bezier_patch.h"
#include "render/passes/stars/search/mended_grid.h"
#include "render/passes/stars/star_field.h"

namespace ergodome {

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

//! Memory for patches, kept from one place to the next: a camera that moves makes them for each picture, and to have the system clear it each time takes a
//! third as long as to make them.
struct PatchRoom {
  std::vector<std::vector<StarPatch>> parts;  //!< of leaves that one thread takes
  std::vector<StarPatch> patches;             //!< of a place that is left
};

//! Where the mended grid is nearer than this to the sky, images are where it has them [px].
inline constexpr float exact_grid_px = 0.008F;

//! A lens grid turned round: from places on the sky to places in the chart.
class StarPatches {
 public:
  //! For images of at least `faintest` lx: the more stars may have some, the finer. Where `station` was not built to be
  //! inverted (GridSettings), all of them need rays. They take the memory of the patches in `room`.
  StarPatches(const LensStation& station, const StarField& field, const ImageLight& light, float faintest,
              const GridExactness& exactness, PatchRoom& room);
  StarPatches(StarPatches&&) = default;
  StarPatches& operator=(StarPatches&&) = default;

  [[nodiscard]] const std::vector<StarPatch>& patches() const { return patches_; }

  //! Their memory, for those of another place.
  [[nodiscard]] std::vector<StarPatch> given_up() && { return std::move(patches_); }

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
  void join(PatchRoom& room);
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
