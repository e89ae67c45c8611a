#pragma once

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
  };

  class Search {
   public:
    ERGO_HD Search(const PatchSearchBatch& batch, int first)
        : batch_(batch),
          first_(first),
          a_(load_lanes<T>(batch.a, first, batch.count)),
          b_(load_lanes<T>(batch.b, first, batch.count)),
          open_(T(0.0F) < T(1.0F)),
          roots_(0.0F) {}

    //! Halves the patch where its control points leave room for stars, down to parts for which Newton's method is safe.
    ERGO_HD void run() {
      constexpr int deepest = 24;
      Part waiting[deepest + 1];
      waiting[0] = {batch_.patch, 0.0F, 0.0F, 1.0F, 1.0F, 0};
      int count = 1;
      if (batch_.shape == PatchShape::bent) {
        // What Newton's method finds is the only root there is. What it does not find may be there all the same.
        add(waiting[0], newton(batch_.patch, open_, {T(0.5F), T(0.5F)}, 1e6F, few_rounds));
      }
      while (count > 0) {
        const Part part = waiting[--count];
        const Mask may = part.depth == 0 ? open_ : may_hold(part.patch);
        if (!any(may)) {
          continue;
        }
        const bool last = part.depth >= batch_.halvings || part.depth >= deepest;
        // Asked every other time: the answer costs more than a halving.
        const bool asked = last || part.depth % 2 == 0;
        const bool regular = part.depth > 0 && asked && is_regular(part.patch);
        if (regular || last) {
          solve(part, may, regular);
          continue;
        }
        halves_of(part, waiting[count], waiting[count + 1]);
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

    ERGO_HD static void halves_of(const Part& part, Part& first, Part& second) {
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
      };
      place(first, part.u, part.v);
      place(second, axis == 0 ? part.u + size_u : part.u, axis == 1 ? part.v + size_v : part.v);
    }

    //! Lanes whose star lies within the box of a part's control points: a box along the part, as parts of a bent patch are slivers that
    //! point all ways.
    ERGO_HD Mask may_hold(const BezierPatch& part) const {
      float x;
      float y;
      long_way(part, x, y);
      // The narrow side first: it sorts most stars out.
      const Mask narrow = open_ & has_both_signs(part, -y, x);
      return any(narrow) ? narrow & has_both_signs(part, x, y) : narrow;
    }

    //! The way in the plane along which a part is longer, about; a unit vector.
    ERGO_HD static void long_way(const BezierPatch& part, float& x, float& y) {
      const auto from_to = [&](int a, int b, int c, int d, float& along_x, float& along_y) {
        const float before = 1.0F / (part.z[a] + part.z[c]);
        const float after = 1.0F / (part.z[b] + part.z[d]);
        along_x = (part.x[b] + part.x[d]) * after - (part.x[a] + part.x[c]) * before;
        along_y = (part.y[b] + part.y[d]) * after - (part.y[a] + part.y[c]) * before;
      };
      float other_x;
      float other_y;
      from_to(0, 3, 12, 15, x, y);
      from_to(0, 12, 3, 15, other_x, other_y);
      const bool first = x * x + y * y > other_x * other_x + other_y * other_y;
      x = first ? x : other_x;
      y = first ? y : other_y;
      const float square = x * x + y * y;
      const bool some = square > 1e-30F;
      const float inverse = some ? 1.0F / sqrt(square) : 0.0F;
      x = some ? x * inverse : 1.0F;
      y = y * inverse;
    }

    //! Lanes whose star has control points on both sides of it, along a unit vector (x, y) of the plane.
    ERGO_HD Mask has_both_signs(const BezierPatch& part, float x, float y) const {
      const T at = x * a_ + y * b_;
      float along[16];
      ERGO_UNROLL
      for (int i = 0; i < 16; ++i) {
        along[i] = x * part.x[i] + y * part.y[i];
      }
      T lowest = along[0] - at * part.z[0];
      T highest = lowest;
      ERGO_UNROLL
      for (int i = 1; i < 16; ++i) {
        const T value = along[i] - at * part.z[i];
        lowest = minimum(lowest, value);
        highest = maximum(highest, value);
      }
      // Roots on a border belong to both sides, whatever rounding says.
      const T slack = 1e-3F * (highest - lowest) + batch_.error;
      return (lowest <= slack) & (highest >= -slack);
    }

    //! Keeps roots that are not there yet.
    ERGO_HD void add(const Part& part, const Found& found) {
      const T u = T(part.u) + part.size_u * found.at.u;
      const T v = T(part.v) + part.size_v * found.at.v;
      const T area = found.area * (1.0F / (part.size_u * part.size_v));
      Mask fresh = open_ & found.found & within_patch<T>({u, v}, beyond_patch);
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
        open_ = open_ & (roots_ < T(1.0F));
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
    Mask open_;  //!< lanes that may have more roots
    T roots_;
    T u_[most_roots] = {};
    T v_[most_roots] = {};
    T area_[most_roots] = {};
  };
};

}  // namespace ergodome::inline ERGO_TARGET
