#pragma once

#include "kernels/stars/search/patch_newton.h"

namespace ergodome::inline ERGO_TARGET {

//! Roots of parts, as positions in their patches and areas per area of the patches' unit square. A
//! part that is not folded has only the first.
template <class T>
struct PartRoots {
  PatchRoot<T> root[max_part_roots];
};

namespace detail {
//! Finds the images of stars in parts of patches.
template <class T>
struct PartSolver {
  using Mask = MaskOf<T>;
  using Position = PatchPosition<T>;

  const SeenPart<T>& part;

  [[nodiscard]] ERGO_HD PartRoots<T> roots(bool folded) const {
    const Mask all = T(0.0F) < T(1.0F);
    PatchRoot<T> root =
        newton_on_patch(part.patch, all, {T(0.5F), T(0.5F)}, folded ? any_step : farthest_regular, rounds_regular);
    // If parts may be folded, roots outside of a part, by up to its size, are accepted as well.
    root.found = root.found & within_patch(root.at, folded ? 1.0F : beyond_patch);
    if (folded) {
      return across_fold(root);
    }
    return {{in_patch(root), in_patch(root)}};
  }

 private:
  [[nodiscard]] ERGO_HD PatchRoot<T> in_patch(const PatchRoot<T>& root) const {
    return {{part.u + part.size_u * root.at.u, part.v + part.size_v * root.at.v},
            root.area / (part.size_u * part.size_v),
            root.found};
  }

  //! Finds the second root of folded parts, if their patch may deviate from the sky (error > 0). At
  //! a fold, images appear in pairs, so a root has a twin across the fold. If no root is found but
  //! the fold passes the star within that error, both are guessed.
  [[nodiscard]] ERGO_HD PartRoots<T> across_fold(const PatchRoot<T>& root) const {
    const T zero(0.0F);
    const SeenPatch<T>& patch = part.patch;
    const T& error = part.error;
    const Mask may_be_off = error > zero;
    const Position at = nearest(patch, root);
    const PlaneValue<T> f = seen_at(patch, at.u, at.v);
    const Fold fold = fold_at(patch, at, f);
    const T to_fold = minimum(maximum(determinant(f) / -fold.slope, T(-0.5F)), T(0.5F));
    const auto beside = [&](const T& way) { return Position{at.u + way * fold.u, at.v + way * fold.v}; };
    const Mask paired = may_be_off & root.found & (absolute(to_fold) < T(0.5F));
    const PatchRoot<T> twin = newton_on_patch(patch, paired, beside(T(2.0F) * to_fold), any_step, rounds_regular);
    const Mask guessed = may_be_off & !root.found & (maximum(absolute(f.p), absolute(f.q)) < error);
    // The distance from the fold at which the error may place the two images.
    const T way = minimum(sqrt(T(2.0F) * error * fold.stretch / absolute(fold.slope)), T(0.25F));
    const auto or_guess = [&](const PatchRoot<T>& found, const Position& guess) {
      return PatchRoot<T>{{select(guessed, guess.u, found.at.u), select(guessed, guess.v, found.at.v)},
                          select(guessed, zero, found.area),
                          MaskOf<T>(found.found | guessed)};
    };
    return {{in_patch(or_guess(root, beside(to_fold + way))), in_patch(or_guess(twin, beside(to_fold - way)))}};
  }

  //! Returns the point of a part that is nearest to its star, by damped least squares; a root found
  //! before is returned as it is.
  ERGO_HD static Position nearest(const SeenPatch<T>& patch, const PatchRoot<T>& root) {
    constexpr int steps = 10;
    constexpr float damping = 1e-4F;
    Position at = {select(root.found, root.at.u, T(0.5F)), select(root.found, root.at.v, T(0.5F))};
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
    T u, v;     //!< unit vector in the part's square along which the map shrinks most
    T slope;    //!< derivative of the Jacobian determinant along (u, v)
    T stretch;  //!< stretch of the map to the sky across (u, v)
  };

  ERGO_HD static Fold fold_at(const SeenPatch<T>& patch, const Position& at, const PlaneValue<T>& f) {
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
}  // namespace detail

//! Finds the roots of the parts first, first + 1, ... `folded`: they may be folded.
template <class T>
ERGO_HD PartRoots<T> solve_parts(const SeenParts& parts, int first, bool folded) {
  const SeenPart<T> part = load_parts<T>(parts, first);
  return detail::PartSolver<T>{part}.roots(folded);
}

//! Seeks stars in parts. Index i covers parts i * lanes to (i + 1) * lanes - 1.
template <class T>
struct SolveParts {
  const SolvePartsBatch& batch;

  ERGO_HD void operator()(int index) const {
    const int first = index * RealTraits<T>::lane_count;
    const int count = batch.parts.count;
    const PartRoots<T> solved = solve_parts<T>(batch.parts, first, batch.folded);
    for (int k = 0; k < (batch.folded ? max_part_roots : 1); ++k) {
      const PatchRoot<T>& root = solved.root[k];
      const auto store = [&](float* to, const T& value) { store_lanes(to + k * count, first, count, value); };
      store(batch.found, select(root.found, T(1.0F), T(0.0F)));
      store(batch.u, root.at.u);
      store(batch.v, root.at.v);
      store(batch.area, root.area);
    }
  }
};

template <class T, class Action>
void dispatch(const SolvePartsBatch& batch, const Action& action) {
  action(SolveParts<T>{batch});
}

}  // namespace ergodome::inline ERGO_TARGET
