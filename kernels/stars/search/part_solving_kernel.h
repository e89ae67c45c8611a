#pragma once

#include "kernels/stars/search/patch_newton.h"
#include "kernels/stars/search/seen_parts.h"

namespace ergodome::inline ERGO_TARGET {

//! Finds the images of stars in parts of patches; index i stands for the parts i * lanes, i * lanes
//! + 1, ...
template <class T>
struct SolveParts {
  using Mask = MaskOf<T>;

  const SolvePartsBatch& batch;

  ERGO_HD void operator()(int index) const {
    const int first = index * RealTraits<T>::lane_count;
    const SeenPatch<T> patch = load_patch<T>(batch.parts, first);
    const Place middle = {T(0.5F), T(0.5F)};
    const Mask all = T(0.0F) < T(1.0F);
    PatchRoot<T> root = newton_on_patch(patch, all, middle, batch.folded ? 1e6F : farthest_regular, rounds);
    // Folded parts also accept roots outside of them.
    root.found = root.found & within_patch(root.at, batch.folded ? 1.0F : beyond_patch);
    if (batch.folded) {
      look_across_fold(first, patch, root);
    } else {
      store(first, 0, root);
    }
  }

 private:
  using Place = PatchPlace<T>;

  static constexpr int rounds = 16;

  [[nodiscard]] ERGO_HD T load(int channel, int first) const {
    return load_lanes<T>(batch.parts.at + channel * batch.parts.room, first, batch.parts.count);
  }

  //! Stores the k-th root of parts.
  ERGO_HD void store(int first, int k, const PatchRoot<T>& root) const {
    const T size_u = load(part_size_u, first);
    const T size_v = load(part_size_v, first);
    const auto put = [&](float* to, const T& value) {
      const int count = batch.parts.count;
      store_lanes(to + k * count, first, count, value);
    };
    put(batch.found, select(root.found, T(1.0F), T(0.0F)));
    put(batch.u, load(part_u, first) + size_u * root.at.u);
    put(batch.v, load(part_v, first) + size_v * root.at.v);
    put(batch.area, root.area / (size_u * size_v));
  }

  //! Finds the second root of folded parts. At a fold, images appear in pairs, so a root has a twin
  //! across the fold. If no root is found but the fold passes the star within the patch's error,
  //! both are guessed.
  ERGO_HD void look_across_fold(int first, const SeenPatch<T>& patch, const PatchRoot<T>& root) const {
    const T zero(0.0F);
    const T error = load(part_error, first);
    const Mask may_be_off = error > zero;
    const Place at = nearest(patch, root);
    const PlaneValue<T> f = seen_at(patch, at.u, at.v);
    const Fold fold = fold_at(patch, at, f);
    const T to_fold = minimum(maximum(determinant(f) / -fold.slope, T(-0.5F)), T(0.5F));
    const auto beside = [&](const T& way) { return Place{at.u + way * fold.u, at.v + way * fold.v}; };
    const Mask paired = may_be_off & root.found & (absolute(to_fold) < T(0.5F));
    const PatchRoot<T> twin = newton_on_patch(patch, paired, beside(T(2.0F) * to_fold), 1e6F, rounds);
    const Mask guessed = may_be_off & !root.found & (maximum(absolute(f.p), absolute(f.q)) < error);
    // The distance from the fold at which the error may place the two images.
    const T way = minimum(sqrt(T(2.0F) * error * fold.stretch / absolute(fold.slope)), T(0.25F));
    const auto or_guess = [&](const PatchRoot<T>& found, const Place& guess) {
      return PatchRoot<T>{{select(guessed, guess.u, found.at.u), select(guessed, guess.v, found.at.v)},
                          select(guessed, zero, found.area),
                          MaskOf<T>(found.found | guessed)};
    };
    store(first, 0, or_guess(root, beside(to_fold + way)));
    store(first, 1, or_guess(twin, beside(to_fold - way)));
  }

  //! Returns the point of a part that is nearest to its star, by damped least squares; a root found
  //! before is returned as it is.
  ERGO_HD static Place nearest(const SeenPatch<T>& patch, const PatchRoot<T>& root) {
    constexpr int steps = 10;
    constexpr float damping = 1e-4F;
    Place at = {select(root.found, root.at.u, T(0.5F)), select(root.found, root.at.v, T(0.5F))};
    const Mask sought = !root.found;
    for (int step = 0; step < steps && any(sought); ++step) {
      const PlaneValue<T> f = seen_at(patch, at.u, at.v);
      const T square_u = f.p_u * f.p_u + f.q_u * f.q_u;
      const T square_v = f.p_v * f.p_v + f.q_v * f.q_v;
      const T both = f.p_u * f.p_v + f.q_u * f.q_v;
      const T damped = damping * (square_u + square_v);
      const T along_u = f.p * f.p_u + f.q * f.q_u;
      const T along_v = f.p * f.p_v + f.q * f.q_v;
      const T det = determinant(f);
      const T inverse = T(1.0F) / (det * det + damped * (square_u + square_v));
      const T du = ((square_v + damped) * along_u - both * along_v) * inverse;
      const T dv = ((square_u + damped) * along_v - both * along_u) * inverse;
      const auto moved = [&](const T& from, const T& way) {
        const T to = from - minimum(maximum(way, T(-0.25F)), T(0.25F));
        return select(sought, minimum(maximum(to, T(-0.25F)), T(1.25F)), from);
      };
      at = {moved(at.u, du), moved(at.v, dv)};
    }
    return at;
  }

  //! The geometry of a fold near a point of a part.
  struct Fold {
    T u, v;     //!< direction that the map shrinks most
    T slope;    //!< derivative of the determinant along (u, v)
    T stretch;  //!< stretch of the map across (u, v)
  };

  ERGO_HD static Fold fold_at(const SeenPatch<T>& patch, const Place& at, const PlaneValue<T>& f) {
    constexpr float step = 0.05F;
    const T square_u = f.p_u * f.p_u + f.q_u * f.q_u;
    const T square_v = f.p_v * f.p_v + f.q_v * f.q_v;
    const T both = f.p_u * f.p_v + f.q_u * f.q_v;
    // Half-angle formulas: half / length is the cosine of twice the angle of the direction that the
    // map stretches most.
    const T half = T(0.5F) * (square_u - square_v);
    const T length = maximum(sqrt(half * half + both * both), T(1e-30F));
    const T cosine = sqrt(maximum(T(0.5F) + T(0.5F) * half / length, T(0.0F)));
    const T size = sqrt(maximum(T(0.5F) - T(0.5F) * half / length, T(0.0F)));
    const T sine = select(both < T(0.0F), -size, size);
    const auto determinant_at = [&](float way) {
      return determinant(seen_at(patch, at.u - way * sine, at.v + way * cosine));
    };
    const T slope = (determinant_at(step) - determinant_at(-step)) * (0.5F / step);
    return {-sine, cosine, select(absolute(slope) > T(1e-30F), slope, T(1e-30F)),
            sqrt(T(0.5F) * (square_u + square_v) + length)};
  }
};

template <class T, class Action>
void dispatch(const SolvePartsBatch& batch, const Action& action) {
  action(SolveParts<T>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
