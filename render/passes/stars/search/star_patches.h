#pragma once

#include <utility>
#include <vector>

#include "content/trajectory/lens_station.h"
#include "kernels/stars/search/patch_measure.h"
#include "kernels/stars/search/search_inputs.h"
#include "render/passes/stars/search/corrected_grid.h"
#include "render/passes/stars/search/sky_frustum.h"
#include "render/passes/stars/star_field.h"

namespace ergodome {

//! Properties of the observer and of starlight that bound the brightness of images in a patch.
class ImageLight {
 public:
  ImageLight() = default;
  virtual ~ImageLight() = default;
  ImageLight(const ImageLight&) = delete;
  ImageLight& operator=(const ImageLight&) = delete;

  //! observer() returns the aberration from the observer's frame to that of the lens chart: the
  //! rain frame (aberration_to_rain()), or for an ODS eye the observer's own. energy() returns a
  //! photon's energy at infinity over its energy in the chart's frame, as a function of the
  //! direction in that frame.
  [[nodiscard]] virtual AberrationOf<float> observer() const = 0;
  [[nodiscard]] virtual DirectionForm<float> energy() const = 0;

  //! Returns bounds of the starlight seen in a patch in which the observer's solid angles are at
  //! most `brightening` times those of the rain frame, and the frequency ratio g is at most
  //! `frequency_ratio`.
  [[nodiscard]] virtual PatchLight light_in(float brightening, float frequency_ratio) const = 0;
};

//! Accuracy of a lens grid that is to be inverted.
struct GridExactness {
  double pixel;  //!< angle of the pixel in which the grid's errors are given [rad]
  //! Maximum displacement on the camera's sky by the grid's errors next to critical curves [rad].
  double fold_error;
};

//! Memory for patches that is reused at the next camera position. A moving camera computes patches
//! for each picture, and new memory, which the system clears, would increase the time by a third.
struct PatchRoom {
  //! Patches of each chunk of leaves; one thread computes a chunk.
  std::vector<std::vector<StarPatch>> parts;
  std::vector<StarPatch> patches;  //!< memory of an earlier set of patches
};

//! Images found in the corrected grid need no rays if its error is below this [px].
inline constexpr float exact_grid_px = 0.008F;

//! An inverted lens grid: patches of the lens chart with the parts of the sky that they show, in
//! which the search finds the chart positions of a star's images.
class StarPatches {
 public:
  //! Computes patches for the search of images of at least `faintest` lx. Patches are finer where
  //! more stars may have such images. If `station` was not built with GridSettings::inverted, all
  //! images need rays. Takes the memory of `room.patches`, which given_up() returns; `room` is not
  //! needed afterwards.
  StarPatches(const LensStation& station, const StarField& field, const ImageLight& light, float faintest,
              const GridExactness& exactness, PatchRoom& room);
  //! Replaces the array of patches.
  StarPatches(StarPatches&& other, std::vector<StarPatch> patches);
  //! The patches of a camera beside that of `middle`. `there`: the camera's chart; `nodes`: traced
  //! nodes of the grid there.
  StarPatches(const StarPatches& middle, const LensStation& there, std::vector<float> nodes,
              std::vector<StarPatch> patches);
  StarPatches(StarPatches&&) = default;
  StarPatches& operator=(StarPatches&&) = default;

  [[nodiscard]] const std::vector<StarPatch>& patches() const { return patches_; }

  //! Returns the array of patches and gives it up, so that its memory can be used for another
  //! position.
  [[nodiscard]] std::vector<StarPatch> given_up() && { return std::move(patches_); }

  //! Returns the inputs of a search, without the field, the view and the turn. put(vector) returns
  //! the address at which the search reads the vector: that of a copy, or of its own data.
  template <class Put>
  [[nodiscard]] SearchInputs view(const Put& put) const {
    SearchInputs inputs{};
    inputs.patches = put(patches_);
    inputs.patch_count = static_cast<int>(patches_.size());
    inputs.sides = mirrored_ ? 2 : 1;
    inputs.faintest = faintest_;
    inputs.corrected = corrected_.view(put);
    return inputs;
  }

 private:
  //! Inputs that decide how far patches are divided.
  struct Wanted {
    const StarField& field;
    const ImageLight& light;
  };

  void add_patch(const Wanted& wanted, const StarPatch& patch, int depth, std::vector<StarPatch>& patches) const;
  void join(PatchRoom& room);
  [[nodiscard]] bool is_done(const Wanted& wanted, const StarPatch& patch, const SkyFrustum& frustum, bool broad) const;
  void set_error(float error_px, StarPatch& patch) const;

  CorrectedGrid corrected_;
  std::vector<float> edge_;  //!< shadow edge in the chart
  LensChart chart_;
  bool mirrored_;   //!< the grid covers half of a sky that is mirror symmetric
  float faintest_;  //!< images of lower illuminance are left out [lx]
  GridExactness exactness_;
  std::vector<StarPatch> patches_;
};

}  // namespace ergodome
