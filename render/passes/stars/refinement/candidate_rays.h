#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "kernels/spacetime/kerr/camera_station.h"
#include "kernels/spacetime/trace/omni_camera.h"
#include "render/passes/stars/refinement/star_candidate.h"

namespace ergodome {

//! Precision of the rays that refine images: single, double, and double with a smaller tolerance
//! next to caustics.
enum class RayKind : std::uint8_t { quick, fine, finest };
inline constexpr std::size_t ray_kinds = 3;

//! Returns the maximum `miss` of an accepted image for a kind of rays [rad]: its estimated distance
//! from its exact position. `pixel`: angle of a pixel [rad].
double last_miss(RayKind kind, double pixel);

//! Traces rays for the candidates of a search. Its destructor adds the number of rays and their
//! time to the WorkCounters; the elapsed time is divided between single and double precision in
//! proportion to the threads' times.
class CandidateRays {
 public:
  explicit CandidateRays(const ImageSearch& search);
  ~CandidateRays();
  CandidateRays(const CandidateRays&) = delete;
  CandidateRays& operator=(const CandidateRays&) = delete;

  //! Returns the number of candidates that one SIMD computation processes together, in the time of
  //! one.
  [[nodiscard]] static std::size_t lanes(RayKind kind);

  //! Makes one Newton step with each candidate, on the calling thread. At most lanes(kind)
  //! candidates.
  void follow(RayKind kind, std::span<StarCandidate* const> candidates);

 private:
  template <class S>
  struct Setup {
    std::variant<CameraStationOf<S>, OmniCameraOf<S>> camera;
    StarChartOf<S> chart;
  };

  template <class S>
  static Setup<S> setup_of(const ImageSearch& search);

  template <class S>
  void follow_in(const Setup<S>& setup, RayKind kind, std::span<StarCandidate* const> candidates) const;

  double pixel_;
  int step_limit_;
  Setup<float> quick_;
  Setup<double> exact_;

  //! Totals over all threads.
  struct Tally {
    std::atomic<long> rays{0};
    std::atomic<long> time_ns{0};
  };

  std::array<Tally, 2> tallies_;  //!< totals of rays in single precision, and of rays in double precision
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace ergodome
