#pragma once

#include <bit>

#include "kernels/core/lanes.h"
#include "kernels/stars/patch_newton.h"
#include "kernels/stars/patch_search.h"

namespace ergodome::inline ERGO_TARGET {

//! Finds where a patch holds stars; index i stands for the stars i * lanes, i * lanes + 1, ... All lanes walk one patch together.
template <class T>
struct SearchPatch {
  using Mask = MaskOf<T>;

  const PatchSearchBatch& batch;

  ERGO_HD void operator()(int index) const {
    Search search{batch, index * RealTraits<T>::lane_count};
    search.run();
    search.store();
  }

 private:
  //! A part of the patch.
  struct Part {
    BezierPatch patch;
    float u, v;
    float size_u, size_v;
    int depth;
    unsigned stars;  //!< lanes that the part it is a half of may hold
  };

  class Search {
   public:
    ERGO_HD Search(const PatchSearchBatch& batch, int first)
        : batch_(batch),
          first_(first),
          a_(load_lanes<T>(batch.a, first, batch.count)),
          b_(load_lanes<T>(batch.b, first, batch.count)),
          open_(bits_within<T>(first, batch.count)),
          roots_(0.0F) {}

    //! Halves the patch where its control points leave room for stars, down to parts for which Newton's method is safe.
    ERGO_HD void run() {
      constexpr int deepest = 24;
      Part waiting[deepest + 1];
      waiting[0] = {batch_.patch, 0.0F, 0.0F, 1.0F, 1.0F, 0, open_};
      int count = 1;
      if (batch_.shape == PatchShape::bent) {
        // What Newton's method finds is the only root there is. What it does not find may be there all the same.
        add(waiting[0], newton(batch_.patch, mask_from_bits<T>(open_), {T(0.5F), T(0.5F)}, 1e6F, few_rounds));
      }
      while (count > 0) {
        const Part part = waiting[--count];
        const unsigned may = part.depth == 0 ? open_ : those_in(part);
        if (may == 0) {
          continue;
        }
        const bool last = part.depth >= batch_.halvings || part.depth >= deepest;
        // Asked every other time: the answer costs more than a halving.
        const bool asked = last || part.depth % 2 == 0;
        const bool regular = part.depth > 0 && asked && is_regular<T>(part.patch);
        if (regular || last) {
          solve(part, mask_from_bits<T>(may), regular);
          continue;
        }
        halves_of(part, may, waiting[count], waiting[count + 1]);
        count += 2;
      }
    }

    ERGO_HD void store() const {
      store_lanes(batch_.roots, first_, batch_.count, roots_);
      for (int k = 0; k < most_roots; ++k) {
        if (any(roots_ > T(static_cast<float>(k)))) {
          store_lanes(batch_.u + k * batch_.count, first_, batch_.count, u_[k]);
          store_lanes(batch_.v + k * batch_.count, first_, batch_.count, v_[k]);
          store_lanes(batch_.area + k * batch_.count, first_, batch_.count, area_[k]);
        }
      }
    }

   private:
    //! A place in a part, and where in it Newton's method ended.
    using Place = PatchPlace<T>;
    using Found = PatchRoot<T>;

    //! Newton's method from a place in a part. A first step longer than `farthest` ends it.
    ERGO_HD Found newton(const BezierPatch& patch, const Mask& wanted, const Place& from, float farthest,
                         int rounds = 16) const {
      return newton_on_patch(patch, a_, b_, wanted, from, farthest, rounds);
    }

    //! Adds the root that a part holds.
    ERGO_HD void solve(const Part& part, const Mask& may, bool regular) {
      const Place middle = {T(0.5F), T(0.5F)};
      Found found = newton(part.patch, may, middle, regular ? farthest_regular : 1e6F);
      // Where a part is not regular, roots are found from beside it, too.
      found.found = found.found & within_patch(found.at, regular ? beyond_patch : 1.0F);
      add(part, found);
      if (!regular && batch_.error > 0.0F) {
        look_across_fold(part, may, found);
      }
    }

    //! Where the map is folded, images are born in pairs: one that is found has a twin across the fold, and where the fold passes a star
    //! within the patch's error, there may be two.
    ERGO_HD void look_across_fold(const Part& part, const Mask& may, const Found& found) {
      const Place at = nearest(part.patch, may, found);
      const PlaneValue<T> f = seen_from(part.patch, a_, b_, at.u, at.v);
      const Fold fold = fold_at(part.patch, at, f);
      const T to_fold = minimum(maximum(determinant(f) / -fold.slope, T(-0.5F)), T(0.5F));
      const auto beside = [&](const T& way) { return Place{at.u + way * fold.u, at.v + way * fold.v}; };
      const Mask paired = may & found.found & (absolute(to_fold) < T(0.5F));
      if (any(paired)) {
        add(part, newton(part.patch, paired, beside(T(2.0F) * to_fold), 1e6F));
      }
      const Mask guessed =
          may & !found.found & (maximum(absolute(f.p), absolute(f.q)) < T(batch_.error)) & (roots_ < T(most_guesses));
      if (any(guessed)) {
        // So far from the fold as the error may have moved it.
        const T way = minimum(sqrt(T(2.0F * batch_.error) * fold.stretch / absolute(fold.slope)), T(0.25F));
        add(part, {beside(to_fold + way), T(0.0F), guessed});
        add(part, {beside(to_fold - way), T(0.0F), guessed});
      }
    }

    //! Where a part comes nearest to a star, by damped least squares; a root is that itself.
    ERGO_HD Place nearest(const BezierPatch& patch, const Mask& may, const Found& found) const {
      constexpr int rounds = 10;
      constexpr float damping = 1e-4F;
      Place at = {select(found.found, found.at.u, T(0.5F)), select(found.found, found.at.v, T(0.5F))};
      const Mask sought = may & !found.found;
      for (int round = 0; round < rounds && any(sought); ++round) {
        const PlaneValue<T> f = seen_from(patch, a_, b_, at.u, at.v);
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
        const auto moved = [&](const T& from, const T& step) {
          const T to = from - minimum(maximum(step, T(-0.25F)), T(0.25F));
          return select(sought, minimum(maximum(to, T(-0.25F)), T(1.25F)), from);
        };
        at = {moved(at.u, du), moved(at.v, dv)};
      }
      return at;
    }

    //! How a part is folded about a place.
    struct Fold {
      T u, v;     //!< the direction that the map shrinks most
      T slope;    //!< of the determinant along it
      T stretch;  //!< of the map across it
    };

    ERGO_HD Fold fold_at(const BezierPatch& patch, const Place& at, const PlaneValue<T>& f) const {
      constexpr float step = 0.05F;
      const T square_u = f.p_u * f.p_u + f.q_u * f.q_u;
      const T square_v = f.p_v * f.p_v + f.q_v * f.q_v;
      const T both = f.p_u * f.p_v + f.q_u * f.q_v;
      // Twice the angle of the direction that the map stretches most, by its cosine.
      const T half = T(0.5F) * (square_u - square_v);
      const T length = maximum(sqrt(half * half + both * both), T(1e-30F));
      const T cosine = sqrt(maximum(T(0.5F) + T(0.5F) * half / length, T(0.0F)));
      const T size = sqrt(maximum(T(0.5F) - T(0.5F) * half / length, T(0.0F)));
      const T sine = select(both < T(0.0F), -size, size);
      const auto determinant_at = [&](float way) {
        return determinant(seen_from(patch, a_, b_, at.u - way * sine, at.v + way * cosine));
      };
      const T slope = (determinant_at(step) - determinant_at(-step)) * (0.5F / step);
      return {-sine, cosine, select(absolute(slope) > T(1e-30F), slope, T(1e-30F)),
              sqrt(T(0.5F) * (square_u + square_v) + length)};
    }

    ERGO_HD static void halves_of(const Part& part, unsigned stars, Part& first, Part& second) {
      const int axis = part.size_u >= part.size_v ? 0 : 1;
      const float size_u = axis == 0 ? 0.5F * part.size_u : part.size_u;
      const float size_v = axis == 1 ? 0.5F * part.size_v : part.size_v;
      split(part.patch, axis, first.patch, second.patch);
      const auto place = [&](Part& half, float u, float v) {
        half.u = u;
        half.v = v;
        half.size_u = size_u;
        half.size_v = size_v;
        half.depth = part.depth + 1;
        half.stars = stars;
      };
      place(first, part.u, part.v);
      place(second, axis == 0 ? part.u + size_u : part.u, axis == 1 ? part.v + size_v : part.v);
    }

    //! Those of a part's stars that lie within the box of its control points: a box along the part, as parts of a bent patch are slivers
    //! that point all ways. Here lanes are control points, as few stars come so far.
    ERGO_HD unsigned those_in(const Part& part) const {
      constexpr int lanes = RealTraits<T>::lane_count;
      constexpr int registers = 16 / lanes;
      float x;
      float y;
      const float length = long_way(part.patch, x, y);
      T depth[registers];
      T along[registers];
      T across[registers];
      for (int k = 0; k < registers; ++k) {
        const T point_x = load_lanes<T>(part.patch.x, k * lanes, 16);
        const T point_y = load_lanes<T>(part.patch.y, k * lanes, 16);
        depth[k] = load_lanes<T>(part.patch.z, k * lanes, 16);
        along[k] = x * point_x + y * point_y;
        across[k] = x * point_y - y * point_x;
      }
      // Roots on a border belong to both sides, whatever rounding says.
      const float slack = 1e-3F * length + batch_.error;
      const auto has_both_signs = [&](const T(&points)[registers], float at) {
        unsigned low = 0;
        unsigned high = 0;
        for (int k = 0; k < registers; ++k) {
          const T value = points[k] - at * depth[k];
          low |= mask_bits(value <= T(slack));
          high |= mask_bits(value >= T(-slack));
        }
        return low != 0 && high != 0;
      };
      unsigned held = 0;
      for (unsigned bits = part.stars & open_; bits != 0; bits &= bits - 1) {
        const int i = std::countr_zero(bits);
        const float a = batch_.a[first_ + i];
        const float b = batch_.b[first_ + i];
        // The narrow side first: it sorts most stars out.
        if (has_both_signs(across, x * b - y * a) && has_both_signs(along, x * a + y * b)) {
          held |= 1U << static_cast<unsigned>(i);
        }
      }
      return held;
    }

    //! The way in the plane along which a part is longer, about: a unit vector. Returns how long.
    ERGO_HD static float long_way(const BezierPatch& part, float& x, float& y) {
      const auto from_to = [](const float(&at)[16], int a, int b, int c, int d) {
        return 0.5F * (at[b] + at[d] - at[a] - at[c]);
      };
      const float along_x = from_to(part.x, 0, 3, 12, 15);
      const float along_y = from_to(part.y, 0, 3, 12, 15);
      const float across_x = from_to(part.x, 0, 12, 3, 15);
      const float across_y = from_to(part.y, 0, 12, 3, 15);
      const float along = along_x * along_x + along_y * along_y;
      const float across = across_x * across_x + across_y * across_y;
      const bool first = along > across;
      const float length = sqrt(first ? along : across);
      const bool some = length > 1e-15F;
      const float inverse = some ? 1.0F / length : 0.0F;
      x = some ? (first ? along_x : across_x) * inverse : 1.0F;
      y = (first ? along_y : across_y) * inverse;
      return length;
    }

    //! Keeps roots that are not there yet.
    ERGO_HD void add(const Part& part, const Found& found) {
      const T u = T(part.u) + part.size_u * found.at.u;
      const T v = T(part.v) + part.size_v * found.at.v;
      const T area = found.area * (1.0F / (part.size_u * part.size_v));
      Mask fresh = mask_from_bits<T>(open_) & found.found & within_patch<T>({u, v}, beyond_patch);
      for (int k = 0; k < most_roots && any(fresh); ++k) {
        const Mask taken = roots_ > T(static_cast<float>(k));
        const T apart = select(taken, maximum(absolute(u_[k] - u), absolute(v_[k] - v)), T(1.0F));
        fresh = fresh & (apart >= T(same_root));
      }
      for (int k = 0; k < most_roots && any(fresh); ++k) {
        const Mask here = fresh & (roots_ <= T(static_cast<float>(k)));
        u_[k] = select(here, u, u_[k]);
        v_[k] = select(here, v, v_[k]);
        area_[k] = select(here, area, area_[k]);
        roots_ = select(here, roots_ + T(1.0F), roots_);
        fresh = fresh & !here;
      }
      if (batch_.shape == PatchShape::bent) {
        open_ &= mask_bits(roots_ < T(1.0F));
      }
    }

    //! Of Newton's method, where another way is left.
    static constexpr int few_rounds = 6;
    //! Roots that may be guesses; the rest of the room is for what Newton's method finds.
    static constexpr float most_guesses = 4.0F;
    //! Roots of a patch that are nearer to each other are one.
    static constexpr float same_root = 2e-3F;
    const PatchSearchBatch& batch_;
    int first_;
    T a_;
    T b_;
    unsigned open_;  //!< lanes that may have more roots, a bit each
    T roots_;
    T u_[most_roots] = {};
    T v_[most_roots] = {};
    T area_[most_roots] = {};
  };
};

}  // namespace ergodome::inline ERGO_TARGET
