#pragma once

#include "kernels/core/lanes.h"
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
      while (count > 0) {
        const Part part = waiting[--count];
        const Mask may = part.depth == 0 ? open_ : may_hold(part.patch);
        if (!any(may)) {
          continue;
        }
        const bool last = part.depth >= batch_.halvings || part.depth >= deepest;
        // Asked every other time: the answer costs more than a halving.
        const bool asked = last || part.depth % 2 == 0;
        const bool regular = part.depth == 0 ? batch_.shape == PatchShape::regular : asked && is_regular(part.patch);
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
    //! Where in a part Newton's method ended.
    struct Found {
      T u, v;
      T area;
      Mask found;
      T nearest;  //!< how near to the star it came, in the plane, and where
      T nearest_u, nearest_v;
    };

    //! Newton's method from the middle of a part. A first step longer than `farthest` ends it.
    ERGO_HD Found newton(const BezierPatch& patch, const Mask& wanted, float farthest) const {
      constexpr int rounds = 16;
      T u(0.5F);
      T v(0.5F);
      T area(1.0F);
      Mask active = wanted;
      Mask found = T(1.0F) < T(0.0F);
      T nearest(1e30F);
      T nearest_u(0.5F);
      T nearest_v(0.5F);
      for (int round = 0; round < rounds && any(active); ++round) {
        const PlaneValue<T> f = seen_from(patch, a_, b_, u, v);
        const T det = determinant(f);
        const T inverse = T(1.0F) / det;
        const T miss = maximum(absolute(f.p), absolute(f.q));
        const Mask nearer = active & (miss < nearest) & within(u, v, beyond);
        nearest = select(nearer, miss, nearest);
        nearest_u = select(nearer, u, nearest_u);
        nearest_v = select(nearer, v, nearest_v);
        const T du = (f.p * f.q_v - f.p_v * f.q) * inverse;
        const T dv = (f.p_u * f.q - f.p * f.q_u) * inverse;
        const T length = maximum(absolute(du), absolute(dv));
        // The comparison is false for what is not a number.
        active = active & (length < T(round == 0 ? farthest : 1e6F));
        const T part = minimum(T(1.0F), T(0.5F) / length);
        u = select(active, u - part * du, u);
        v = select(active, v - part * dv, v);
        area = select(active, det, area);
        active = active & (u > T(-1.0F)) & (u < T(2.0F)) & (v > T(-1.0F)) & (v < T(2.0F));
        const Mask settled = active & (length < T(settled_step));
        found = found | settled;
        active = active & !settled;
      }
      return {u, v, area, found, nearest, nearest_u, nearest_v};
    }

    //! Adds the root that a part holds.
    ERGO_HD void solve(const Part& part, const Mask& may, bool regular) {
      Found found = newton(part.patch, may, regular ? farthest_regular : 1e6F);
      // Where a part is not regular, roots are found from beside it, too.
      const float margin = regular ? beyond : 1.0F;
      found.found = found.found & within(found.u, found.v, margin);
      if (!regular && batch_.error > 0.0F) {
        // Places for rays to start from, as long as there is room for roots.
        const Mask guessed = may & !found.found & (found.nearest < T(batch_.error)) & (roots_ < T(most_guesses));
        found.u = select(guessed, found.nearest_u, found.u);
        found.v = select(guessed, found.nearest_v, found.v);
        found.area = select(guessed, T(0.0F), found.area);
        found.found = found.found | guessed;
      }
      found.u = T(part.u) + part.size_u * found.u;
      found.v = T(part.v) + part.size_v * found.v;
      found.area = found.area * (1.0F / (part.size_u * part.size_v));
      add(found, found.found & within(found.u, found.v, beyond));
    }

    ERGO_HD static Mask within(const T& u, const T& v, float margin) {
      return (u > T(-margin)) & (u < T(1.0F + margin)) & (v > T(-margin)) & (v < T(1.0F + margin));
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

    //! Lanes whose star lies within the box of a part's control points.
    ERGO_HD Mask may_hold(const BezierPatch& part) const {
      // The narrow side of a patch first: it sorts most stars out.
      const Mask narrow = open_ & has_both_signs(part.y, part.z, b_);
      return any(narrow) ? narrow & has_both_signs(part.x, part.z, a_) : narrow;
    }

    ERGO_HD Mask has_both_signs(const float (&points)[16], const float (&depths)[16], const T& at) const {
      T lowest = points[0] - at * depths[0];
      T highest = lowest;
      ERGO_UNROLL
      for (int i = 1; i < 16; ++i) {
        const T value = points[i] - at * depths[i];
        lowest = minimum(lowest, value);
        highest = maximum(highest, value);
      }
      // Roots on a border belong to both sides, whatever rounding says.
      const T slack = 1e-3F * (highest - lowest) + batch_.error;
      return (lowest <= slack) & (highest >= -slack);
    }

    //! Keeps roots that are not there yet.
    ERGO_HD void add(const Found& found, const Mask& where) {
      Mask fresh = open_ & where;
      for (int k = 0; k < most_roots && any(fresh); ++k) {
        const Mask taken = roots_ > T(static_cast<float>(k));
        const T apart = select(taken, maximum(absolute(u_[k] - found.u), absolute(v_[k] - found.v)), T(1.0F));
        fresh = fresh & (apart >= T(same_root));
      }
      for (int k = 0; k < most_roots && any(fresh); ++k) {
        const Mask here = fresh & (roots_ <= T(static_cast<float>(k)));
        u_[k] = select(here, found.u, u_[k]);
        v_[k] = select(here, found.v, v_[k]);
        area_[k] = select(here, found.area, area_[k]);
        roots_ = select(here, roots_ + T(1.0F), roots_);
        fresh = fresh & !here;
      }
      if (batch_.shape == PatchShape::bent) {
        open_ = open_ & (roots_ < T(1.0F));
      }
    }

    //! Roots that may be guesses; the rest of the room is for what Newton's method finds.
    static constexpr float most_guesses = 4.0F;
    //! In parts of what is searched: Newton's last step, which leaves no more than its square.
    static constexpr float settled_step = 1e-3F;
    //! Newton's first step to a root inside a regular part: half the part, and as much of that as the Jacobian may change.
    static constexpr float farthest_regular = 0.51F * (1.3F + most_regular_change);
    //! Roots of a patch that are nearer to each other are one.
    static constexpr float same_root = 2e-3F;
    //! Images are sought so far beyond a patch, in parts of it: on borders, neither side may lose one.
    static constexpr float beyond = 2e-3F;

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
