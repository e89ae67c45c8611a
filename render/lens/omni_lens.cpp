#include "render/lens/omni_lens.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/core/error.h"
#include "render/lens/direct_lens.h"

namespace ergodome {

namespace {

//! Returns whether two numbers are equal up to the rounding errors of a head that circles the spin
//! axis, which do not change frames.
bool omni_numbers_alike(double a, double b) { return std::abs(a - b) <= 1e-10 * (1.0 + std::abs(a)); }

//! Returns the head's camera with the identity as frame_from_view, because ODS cameras compute in
//! the view's axes.
EyeCamera head_in_view(const EyeAtOffset& eye_at) {
  EyeCamera head = eye_at({0.0, 0.0, 0.0});
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      head.frame_from_view[i][j] = i == j ? 1.0 : 0.0;
    }
  }
  return head;
}

}  // namespace

std::shared_ptr<const OmniEye> make_omni_eye(std::shared_ptr<const OmniCamera> cameras, double side,
                                             const EyeAtOffset& eye_at) {
  const OmniCameraOf<double> exact = cameras->exact(side);
  const ShadowChart chart = omni_shadow_chart(exact, eye_at);
  std::vector<float> edge = solve_omni_edge(exact, chart, edge_points);
  return std::make_shared<const OmniEye>(
      OmniEye{std::move(cameras), side, head_in_view(eye_at), chart, std::move(edge)});
}

std::optional<OmniPair> make_omni_pair(Backend backend, const EyeAtOffset& eye_at, const OmniSettings& settings) {
  try {
    const auto cameras = std::make_shared<const OmniCamera>(backend, eye_at, settings);
    return OmniPair{make_omni_eye(cameras, -1.0, eye_at), make_omni_eye(cameras, 1.0, eye_at)};
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::shared_ptr<const OmniEye> make_omni_eye_for_trails(std::shared_ptr<const OmniCamera> cameras, double side,
                                                        const EyeAtOffset& eye_at) {
  return std::make_shared<const OmniEye>(OmniEye{std::move(cameras), side, head_in_view(eye_at), {}, {}});
}

bool see_alike(const OmniEye& first, const OmniEye& second) {
  const OmniCameraOf<double> a = first.cameras->exact(first.side);
  const OmniCameraOf<double> b = second.cameras->exact(second.side);
  return a.spin == b.spin && a.degree == b.degree && a.ingoing == b.ingoing && omni_numbers_alike(a.offset, b.offset) &&
         omni_numbers_alike(a.inverse_convergence, b.inverse_convergence) &&
         omni_numbers_alike(a.fade_begin, b.fade_begin) && omni_numbers_alike(a.fade_scale, b.fade_scale) &&
         omni_numbers_alike(a.inverse_reach, b.inverse_reach) && omni_numbers_alike(a.turn, b.turn) &&
         std::equal(a.coefficients, a.coefficients + omni_numbers * omni_terms(a.degree), b.coefficients,
                    omni_numbers_alike);
}

OmniLens::OmniLens(Backend backend, std::shared_ptr<const OmniEye> eye, const Projection& projection,
                   double tolerance_px)
    : backend_(backend),
      eye_(std::move(eye)),
      edge_(backend, eye_->chart, eye_->edge),
      prototype_{pixel_batch(eye_->head, projection, tolerance_px), eye_->cameras->view(eye_->side)} {
  set_edge(prototype_.pixels, edge_.view(), projection);
}

void OmniLens::fill(int first_row, int row_count, const LensPixels& out) const {
  OmniBatch batch = prototype_;
  batch.pixels.first_row = first_row;
  batch.pixels.row_count = row_count;
  batch.pixels.out = out;
  launch(backend_, batch);
}

OmniGridLens::OmniGridLens(std::shared_ptr<const OmniEye> eye, const std::shared_ptr<const StationBuffers>& station,
                           const Projection& projection, double tolerance_px)
    : eye_(std::move(eye)),
      station_(station),
      prototype_{pixel_batch(eye_->head, projection, tolerance_px), station_.view(),
                 converted_aberration<float>(no_aberration()), eye_->cameras->on_host(eye_->side)} {}

void OmniGridLens::fill(int first_row, int row_count, const LensPixels& out) const {
  OmniLookUpBatch batch = prototype_;
  batch.pixels.first_row = first_row;
  batch.pixels.row_count = row_count;
  batch.pixels.out = out;
  launch(batch);
}

LensStation build_omni_station(const OmniEye& eye, const GridSettings& settings, GridStatistics* statistics) {
  return build_omni_station(eye.cameras->on_host(eye.side), eye.chart, eye.edge, settings, statistics);
}

}  // namespace ergodome
