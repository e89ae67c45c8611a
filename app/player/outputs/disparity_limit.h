#pragma once

namespace ergodome {

//! Keeps the disparities in a headset comfortable: reduces the distance between the eyes while the
//! range of disparities exceeds StereoSettings::comfort_deg. Disparities are almost proportional to
//! that distance, but grow toward the hole.
class DisparityLimit {
 public:
  //! Returns whether to measure the disparities of the next picture. Measuring may take tens of
  //! milliseconds, so it is due once per second.
  [[nodiscard]] bool is_due(double now_s) const;

  //! Takes the measured range of a picture. Ignores it unless a measurement is due: the eyes of a
  //! picture that was requested before the last one was noted may have another distance.
  void note(double now_s, double range_deg, double comfort_deg);

  //! Returns the factor on the distance between the eyes: 1 without a reduction.
  [[nodiscard]] double factor() const { return factor_; }

  //! Returns whether a reduction began since the last call.
  [[nodiscard]] bool take_news();

  //! Ends a reduction at the start of another show.
  void begin() { *this = {}; }

 private:
  double factor_ = 1.0;
  double noted_s_ = -1e9;
  bool news_ = false;
};

}  // namespace ergodome
