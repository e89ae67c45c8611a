#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "kernels/eyes/omni/omni_camera.h"
#include "kernels/spacetime/kerr/camera_station.h"
#include "render/passes/stars/search/star_candidate.h"

namespace ergodome {

//! How exact rays are that images are followed by: in float, in double, and in double next to caustics.
enum class RayKind : std::uint8_t { quick, fine, finest };
inline constexpr std::size_t ray_kinds = 3;

//! How near an image has to be for its last step [rad].
double last_miss(RayKind kind, double pixel);

//! Rays for the candidates of a search. They are counted where it ends (WorkCounter), its time by the clock shared between rays in float and in
//! double as threads' time is.
class CandidateRays {
 public:
  explicit CandidateRays(const ImageSearch& search);
  ~CandidateRays();
  CandidateRays(const CandidateRays&) = delete;
  CandidateRays& operator=(const CandidateRays&) = delete;

  //! So many candidates are followed in the time of one, at the most.
  [[nodiscard]] static std::size_t lanes(RayKind kind);

  //! Makes a step of Newton's method with each of at most as many candidates as there are lanes, on the thread that calls.
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

  //! Of threads, together.
  struct Tally {
    std::atomic<long> rays{0};
    std::atomic<long> time_ns{0};
  };

  std::array<Tally, 2> tallies_;  //!< in float, in double
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace ergodome
