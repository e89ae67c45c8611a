#pragma once

#include "kernels/eyes/flat/eye_path.h"

namespace ergodome::inline ERGO_TARGET {

//! The lines of sight of a pixel's samples, for an eye of the stereo model `flat`, and the head's
//! rays that represent them. As the head sees them, the lines are strips side by side that all run
//! in the same direction. The exception is an eye that looks along its displacement from the head:
//! there the lines are short, and diverge. The rays lie in rows along that displacement; each
//! represents the parts of all lines that pass near it.
class PixelLines {
 public:
  static constexpr int max_lines = 16;
  //! Height of a row, as a fraction of a part: with this, the corners of a part are hardly farther
  //! from the ray than its ends.
  static constexpr double row_part = 0.7;
  //! Distance of the corners from the ray, over half a part: √(1 + row_part²).
  static constexpr double corner_reach = 1.22;

  //! Begins with lines in the given directions, except those without unit length, in the range
  //! `reach` where objects may be. `part`: length of a line that one ray may represent, as the head
  //! sees it [rad].
  ERGO_HD void begin(const FlatEyeSight& sight, const FlatReach& reach, double part, const Vector3<double>* directions,
                     int count) {
    eye_ = sight.eye;
    from_w_ = static_cast<double>(reach.max_w);
    to_w_ = static_cast<double>(reach.min_w);
    count_ = count;
    gather(directions);
    if (open_ != 0U && from_w_ > to_w_) {
      lay_rays(part);
    }
  }

  //! Moves on to the next ray, nearest first. Returns false if no more rays are needed.
  ERGO_HD bool next() {
    for (++ray_; ray_ < rows_ * columns_; ++ray_) {
      if (turn()) {
        return true;
      }
    }
    return false;
  }

  //! Return the current ray of the head (in EyeReference::m, no line of sight is set yet), and the
  //! maximum angle between it and the directions that it represents [rad].
  [[nodiscard]] ERGO_HD const EyeReference& reference() const { return reference_; }
  [[nodiscard]] ERGO_HD double reach() const { return reach_; }

  //! Returns the range of distances that the current ray represents, over all lines.
  [[nodiscard]] ERGO_HD const DistanceSpan& span() const { return whole_; }
  //! Returns the range of distances for one line. If lines are not cut into parts, the range is the
  //! same for all.
  [[nodiscard]] ERGO_HD const DistanceSpan& span(int line) const { return columns_ > 1 ? spans_[line] : whole_; }

  //! Returns whether the current ray represents a part of this line, and the line is still to be
  //! searched.
  [[nodiscard]] ERGO_HD bool is_wanted(int line) const { return is_in(wanted_ & open_, line); }
  [[nodiscard]] ERGO_HD bool any_wanted() const { return (wanted_ & open_) != 0U; }

  [[nodiscard]] ERGO_HD const Vector3<double>& direction(int line) const { return lines_[line].m; }

  //! Records that a line has met something, which ends the search along it. The search goes on for
  //! lines whose farther parts come first (backwards_).
  ERGO_HD void meet(int line) {
    if (!is_in(backwards_, line)) {
      open_ &= ~(1U << static_cast<unsigned>(line));
    }
  }

 private:
  //! Overlap of parts, as a fraction of their width, since neighbors do not meet to the last digit.
  static constexpr double overlap = 1e-3;

  //! A line of sight in direction m, and the path that its points follow as the head sees them.
  //! Coordinates are on the plane that touches the sphere of the head's directions in the middle of
  //! the pixel: s along the eye's displacement, t across it. `ahead` and `along`: components of m
  //! along the middle and the displacement.
  struct Line {
    Vector3<double> m;
    double ahead, along;
    double from_s, to_s;  //!< s at the maximum and at the minimum nearness
    double from_t, to_t;
  };

  ERGO_HD static bool is_in(unsigned set, int line) { return (set >> static_cast<unsigned>(line) & 1U) != 0U; }

  ERGO_HD void gather(const Vector3<double>* directions) {
    Vector3<double> sum = {0.0, 0.0, 0.0};
    open_ = 0U;
    for (int k = 0; k < count_; ++k) {
      lines_[k].m = directions[k];
      const double square = dot(directions[k], directions[k]);
      if (square > 0.5 && square < 2.0) {
        open_ |= 1U << static_cast<unsigned>(k);
        sum = sum + directions[k];
      }
    }
    middle_ = open_ != 0U ? (1.0 / length_of(sum)) * sum : Vector3<double>{1.0, 0.0, 0.0};
    rows_ = 0;
    columns_ = 0;
    ray_ = -1;
    backwards_ = 0U;
    wanted_ = 0U;
    turn_reference(middle_);
  }

  ERGO_HD void turn_reference(const Vector3<double>& toward) { reference_ = eye_reference(toward, eye_, 0.0); }

  //! Distributes rays over all positions that the lines sweep over.
  ERGO_HD void lay_rays(double part) {
    eye_ahead_ = dot(eye_, middle_);
    const Vector3<double> aside = eye_ - eye_ahead_ * middle_;
    eye_along_ = length_of(aside);
    along_ = eye_along_ > 1e-9 * length_of(eye_) ? (1.0 / eye_along_) * aside : reference_.across;
    across_ = cross(middle_, along_);
    double high_s = -1e30;
    double high_t = -1e30;
    low_s_ = 1e30;
    low_t_ = 1e30;
    for (int k = 0; k < count_; ++k) {
      if (!is_in(open_, k)) {
        continue;
      }
      Line& line = lines_[k];
      line.ahead = dot(line.m, middle_);
      line.along = dot(line.m, along_);
      line.from_s = position(line, along_, from_w_);
      line.to_s = position(line, along_, to_w_);
      line.from_t = position(line, across_, from_w_);
      line.to_t = position(line, across_, to_w_);
      if (line.from_s < line.to_s) {
        backwards_ |= 1U << static_cast<unsigned>(k);
      }
      low_s_ = ::fmin(low_s_, ::fmin(line.from_s, line.to_s));
      high_s = ::fmax(high_s, ::fmax(line.from_s, line.to_s));
      low_t_ = ::fmin(low_t_, ::fmin(line.from_t, line.to_t));
      high_t = ::fmax(high_t, ::fmax(line.from_t, line.to_t));
    }
    columns_ = 1 + static_cast<int>((high_s - low_s_) / part);
    rows_ = 1 + static_cast<int>((high_t - low_t_) / (row_part * part));
    width_ = (high_s - low_s_) / columns_;
    height_ = (high_t - low_t_) / rows_;
  }

  [[nodiscard]] ERGO_HD double position(const Line& line, const Vector3<double>& axis, double w) const {
    const Vector3<double> v = line.m + w * eye_;
    return dot(v, axis) / dot(v, middle_);
  }

  //! Returns the nearness at which a line comes to a position s, limited to the line's ends.
  [[nodiscard]] ERGO_HD double nearness_at(const Line& line, double s) const {
    const bool backwards = line.from_s < line.to_s;
    if (s >= ::fmax(line.from_s, line.to_s)) {
      return backwards ? to_w_ : from_w_;
    }
    if (s <= ::fmin(line.from_s, line.to_s)) {
      return backwards ? from_w_ : to_w_;
    }
    return ::fmax(to_w_, ::fmin(from_w_, (s * line.ahead - line.along) / (eye_along_ - s * eye_ahead_)));
  }

  //! Sets up ray number ray_. Returns whether any line needs it.
  ERGO_HD bool turn() {
    const int row = ray_ / columns_;
    const int column = columns_ - 1 - (ray_ - row * columns_);
    const double s = low_s_ + (column + 0.5) * width_;
    const double t = low_t_ + (row + 0.5) * height_;
    const double half = (0.5 + overlap) * width_;
    double aside = 0.0;
    wanted_ = 0U;
    whole_ = {1e30, 0.0};
    for (int k = 0; k < count_; ++k) {
      const Line& line = lines_[k];
      if (is_in(open_, k) && row_of(line) == row && set_span(k, s, half)) {
        wanted_ |= 1U << static_cast<unsigned>(k);
        aside = ::fmax(aside, ::fmax(::fabs(line.from_t - t), ::fabs(line.to_t - t)));
        whole_ = {::fmin(whole_.nearest, spans_[k].nearest), ::fmax(whole_.farthest, spans_[k].farthest)};
      }
    }
    if (wanted_ == 0U) {
      return false;
    }
    const Vector3<double> toward = middle_ + s * along_ + t * across_;
    turn_reference((1.0 / length_of(toward)) * toward);
    reach_ = ::sqrt(half * half + aside * aside);
    return true;
  }

  //! Sets the range of a line within a column. Returns false if the line does not pass the column.
  ERGO_HD bool set_span(int k, double s, double half) {
    const Line& line = lines_[k];
    const double one = nearness_at(line, s - half);
    const double other = nearness_at(line, s + half);
    double maximum = ::fmax(one, other);
    double minimum = ::fmin(one, other);
    // A line of sight that the head sees at a single position s is in one column of rays as a
    // whole.
    const bool stays = ::fabs(line.from_s - line.to_s) <= 1e-6 * width_;
    if (stays ? !(::fabs(line.from_s - s) <= half) : !(maximum > minimum)) {
      return false;
    }
    if (stays) {
      maximum = from_w_;
      minimum = to_w_;
    }
    EyeReference own = reference_;
    own.m = line.m;
    spans_[k] = {own.distance(maximum), own.distance(minimum)};
    return true;
  }

  [[nodiscard]] ERGO_HD int row_of(const Line& line) const {
    const double t = 0.5 * (line.from_t + line.to_t) - low_t_;
    const int row = height_ > 0.0 ? static_cast<int>(t / height_) : 0;
    return row < rows_ ? row : rows_ - 1;
  }

  Vector3<double> eye_;
  double from_w_ = 0.0, to_w_ = 0.0;
  Vector3<double> middle_, along_, across_;
  double eye_ahead_ = 0.0, eye_along_ = 0.0;
  Line lines_[max_lines];
  int count_ = 0;
  unsigned open_ = 0U, backwards_ = 0U, wanted_ = 0U;  //!< sets of lines, one bit per line
  int rows_ = 0, columns_ = 0;
  double low_s_ = 0.0, low_t_ = 0.0, width_ = 0.0, height_ = 0.0;
  int ray_ = -1;
  EyeReference reference_;
  double reach_ = 0.0;
  DistanceSpan whole_ = {0.0, 0.0};
  DistanceSpan spans_[max_lines];
};

}  // namespace ergodome::inline ERGO_TARGET
