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

namespace ergodome {

//! One eye that turns with the azimuth one looks at, and the shadow that it sees.
struct OmniEye {
  std::shared_ptr<const OmniCamera> cameras;
  double side;        //!< -1: left, 1: right
  EyeCamera head;     //!< with the view's axes for its frame
  ShadowChart chart;  //!< about the shadow, in the view's axes
  std::vector<float>
      edge;  //!< the shadow's edge about the chart's centre at equal steps of the position angle [rad]; or nothing
};

//! Throws Error where the shadow is not in one piece.
std::shared_ptr<const OmniEye> make_omni_eye(std::shared_ptr<const OmniCamera> cameras, double side,
                                             const EyePlace& eye_at);

//! Eyes that turn: the left one and the right one.
using OmniPair = std::array<std::shared_ptr<const OmniEye>, 2>;

//! Both eyes about a head; nothing where they are too far apart for this place.
std::optional<OmniPair> make_omni_pair(Backend backend, const EyePlace& eye_at, const OmniSettings& settings);

//! The same as make_omni_eye without the edge, for images of stars that are followed from another moment: it costs little.
std::shared_ptr<const OmniEye> make_omni_eye_for_trails(std::shared_ptr<const OmniCamera> cameras, double side,
                                                        const EyePlace& eye_at);

//! Whether two eyes see the same but for the head's azimuth, and for what rounding changes where it goes round.
bool see_alike(const OmniEye& first, const OmniEye& second);

//! The exact lens of such an eye: a ray a pixel, each from its own camera.
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

//! Its lens read from a grid of its own, on the processor.
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
