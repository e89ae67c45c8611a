#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "kernels/eyes/omni/omni_batches.h"
#include "render/eyes/omni_camera.h"
#include "render/lens/grid/edge_table.h"
#include "render/lens/grid/grid_builder.h"
#include "render/lens/lens_source.h"
#include "render/lens/stations/station_blend.h"

// Lenses for omnidirectional stereo (ODS), traced or read from a grid.

namespace ergodome {

//! One eye of omnidirectional stereo (ODS), whose position turns with the viewing azimuth, and the
//! shadow that it sees.
struct OmniEye {
  std::shared_ptr<const OmniCamera> cameras;
  double side;        //!< -1: left, 1: right
  EyeCamera head;     //!< camera of the head; its frame is the view's axes
  ShadowChart chart;  //!< chart centered on the shadow, in the view's axes
  //! Polar angles [rad] of the shadow's edge around the chart's center, at equal steps of the
  //! position angle; empty for trails.
  std::vector<float> edge;
};

//! Builds an eye and computes its shadow edge. Throws Error if the shadow is not a single connected
//! region.
std::shared_ptr<const OmniEye> make_omni_eye(std::shared_ptr<const OmniCamera> cameras, double side,
                                             const EyeAtOffset& eye_at);

//! The left and the right ODS eye.
using OmniPair = std::array<std::shared_ptr<const OmniEye>, 2>;

//! Builds both eyes about a head. Returns nothing if their baseline is too large at this position,
//! or if the shadow of one is not a single connected region.
std::optional<OmniPair> make_omni_pair(Backend backend, const EyeAtOffset& eye_at, const OmniSettings& settings);

//! Like make_omni_eye(), but without the shadow edge. Cheap; used to follow star images to another
//! moment, for trails.
std::shared_ptr<const OmniEye> make_omni_eye_for_trails(std::shared_ptr<const OmniCamera> cameras, double side,
                                                        const EyeAtOffset& eye_at);

//! Returns whether two eyes see the same, up to rounding and the azimuth of the head.
bool see_alike(const OmniEye& first, const OmniEye& second);

//! The exact lens of an ODS eye: one ray per pixel, each from its own camera.
class OmniLens : public LensSource {
 public:
  OmniLens(Backend backend, std::shared_ptr<const OmniEye> eye, const Projection& projection, double tolerance_px);

  void fill(int first_row, int row_count, const LensPixels& out) const override;
  [[nodiscard]] const char* name() const override { return "direct"; }

 private:
  Backend backend_;
  std::shared_ptr<const OmniEye> eye_;
  EdgeTable edge_;
  OmniBatch prototype_;
};

//! The lens of an ODS eye read from a grid, on the CPU.
class OmniGridLens : public LensSource {
 public:
  OmniGridLens(std::shared_ptr<const OmniEye> eye, const std::shared_ptr<const StationBuffers>& station,
               const Projection& projection, double tolerance_px);

  void fill(int first_row, int row_count, const LensPixels& out) const override;
  [[nodiscard]] const char* name() const override { return "live"; }

 private:
  std::shared_ptr<const OmniEye> eye_;
  StationBlend station_;
  OmniLookUpBatch prototype_;
};

//! Builds the grid that OmniGridLens reads; see build_omni_station.
LensStation build_omni_station(const OmniEye& eye, const GridSettings& settings, GridStatistics* statistics = nullptr);

}  // namespace ergodome
