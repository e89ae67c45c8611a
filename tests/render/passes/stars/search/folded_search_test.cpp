#include "render/passes/stars/search/folded_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "kernels/launch/launch.h"
#include "tests/support/patch_maps.h"

namespace ergodome {
namespace {

//! Returns pairs of patch 0 and stars at `a` and `b`.
std::vector<SearchedPair> pairs_of(const std::vector<float>& a, const std::vector<float>& b) {
  std::vector<SearchedPair> pairs;
  pairs.reserve(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    pairs.push_back({0, 0, 1.0F, a[i], b[i], false});
  }
  return pairs;
}

//! Tests of the search in a folded patch: it may contain several images (roots) of the same star.
class FoldedPatch : public testing::Test {
 protected:
  //! Finds the roots of `map`, a map from [0, 1]² to the plane, for the stars at the positions (a_,
  //! b_). Sorts them by v.
  //! `error`: see StarPatch.
  template <class Map>
  void search(const Map& map, float error = 0.0F, PatchShape shape = PatchShape::folded) {
    StarPatch patch{};
    patch.sky = test::patch_of(map);
    patch.error = error;
    patch.halvings = 12;
    patch.shape = shape;
    const std::vector<SearchedPair> pairs = pairs_of(a_, b_);
    search_.search({static_cast<int>(pairs.size()), pairs.data(), &patch});
  }

  [[nodiscard]] std::vector<double> roots_along_u(std::size_t star) const {
    std::vector<double> along;
    for (const FoldedRoot& root : search_.roots(star)) {
      along.push_back(static_cast<double>(root.u));
    }
    std::ranges::sort(along);
    return along;
  }

  //! Creates stars at random positions within a rectangle of the plane.
  void scatter(double low_a, double high_a, double low_b, double high_b) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 1003; ++i) {
      a_.push_back(static_cast<float>(low_a + (high_a - low_a) * uniform(random)));
      b_.push_back(static_cast<float>(low_b + (high_b - low_b) * uniform(random)));
    }
  }

  std::vector<float> a_;
  std::vector<float> b_;
  FoldedSearch search_;
};

//! A map with a fold at u = 0.4.
std::array<double, 2> fold(double u, double v) { return {0.1 * (u - 0.4) * (u - 0.4), 0.1 * (v - 0.5) + 0.02 * u}; }

TEST_F(FoldedPatch, HoldsAStarOnBothSidesOfItsFold) {
  scatter(0.0003, 0.012, -0.02, 0.02);
  search(fold);
  for (std::size_t i = 0; i < a_.size(); ++i) {
    const double way = std::sqrt(static_cast<double>(a_[i]) / 0.1);
    const std::vector<double> found = roots_along_u(i);
    ASSERT_EQ(found.size(), 2U) << a_[i] << ' ' << b_[i];
    EXPECT_NEAR(found[0], 0.4 - way, 1e-4);
    EXPECT_NEAR(found[1], 0.4 + way, 1e-4);
  }
}

TEST_F(FoldedPatch, TellsOnWhichSideOfItsFoldEachRootIs) {
  scatter(0.0003, 0.012, -0.02, 0.02);
  search(fold);
  for (std::size_t i = 0; i < a_.size(); ++i) {
    for (const FoldedRoot& root : search_.roots(i)) {
      const double exact = 0.02 * (static_cast<double>(root.u) - 0.4);
      EXPECT_NEAR(static_cast<double>(root.area), exact, 5e-3 * std::abs(exact));
    }
  }
}

TEST_F(FoldedPatch, HoldsNoStarBehindItsFold) {
  scatter(-0.01, -1e-5, -0.02, 0.02);
  search(fold);
  for (std::size_t i = 0; i < a_.size(); ++i) {
    EXPECT_TRUE(search_.roots(i).empty());
  }
}

TEST_F(FoldedPatch, GuessesTwoPlacesWhereItsErrorMayHideAStarBehindItsFold) {
  scatter(-1e-5, -1e-6, -0.02, 0.02);
  search(fold, 1e-4F);
  std::size_t guessed = 0;
  for (std::size_t i = 0; i < a_.size(); ++i) {
    const std::vector<double> found = roots_along_u(i);
    guessed += found.size() >= 2 && found.front() < 0.4 && found.back() > 0.4 ? 1U : 0U;
    EXPECT_TRUE(std::ranges::all_of(search_.roots(i), [](const FoldedRoot& root) { return root.area == 0.0F; }));
  }
  EXPECT_EQ(guessed, a_.size());
}

//! A map with a cusp: p = x³ - x y. Inside the cusp, three points have the same image.
std::array<double, 2> cusp(double u, double v) {
  const double x = u - 0.5;
  const double y = v - 0.3;
  return {x * x * x - 0.5 * x * y, 0.2 * y};
}

TEST_F(FoldedPatch, HoldsAStarThreeTimesWithinItsCusp) {
  scatter(-0.02, 0.02, 0.01, 0.06);
  search(cusp);
  for (std::size_t i = 0; i < a_.size(); ++i) {
    const auto a = static_cast<double>(a_[i]);
    const double slope = 0.5 * static_cast<double>(b_[i]) / 0.2;
    // By Cardano, x³ - slope x - a has three roots if 4 slope³ > 27 a², otherwise one.
    const double inside = 4.0 * slope * slope * slope - 27.0 * a * a;
    if (std::abs(inside) < 1e-5) {
      continue;
    }
    const std::vector<double> found = roots_along_u(i);
    ASSERT_EQ(found.size(), inside > 0.0 ? 3U : 1U) << a_[i] << ' ' << b_[i];
    for (const double u : found) {
      const double x = u - 0.5;
      EXPECT_NEAR(x * x * x - slope * x, a, 1e-6);
    }
  }
}

TEST_F(FoldedPatch, IsLeftWithItsFirstRootWhereOneIsWanted) {
  scatter(0.0003, 0.012, -0.02, 0.02);
  search(fold, 0.0F, PatchShape::bent);
  for (std::size_t i = 0; i < a_.size(); ++i) {
    EXPECT_EQ(search_.roots(i).size(), 1U);
  }
}

TEST_F(FoldedPatch, WithoutExtentHoldsAStarNoMoreOftenThanThereIsRoom) {
  scatter(0.0, 0.0, 0.0, 0.0);
  a_.resize(3);
  b_.resize(3);
  search([](double, double) { return std::array<double, 2>{0.0, 0.0}; }, 1e-4F);
  for (std::size_t i = 0; i < a_.size(); ++i) {
    EXPECT_LE(search_.roots(i).size(), static_cast<std::size_t>(max_roots));
  }
}

TEST_F(FoldedPatch, OfWhatIsNoNumberHoldsNoStar) {
  scatter(-0.01, 0.01, -0.01, 0.01);
  search([](double, double) { return std::array<double, 2>{std::nan(""), std::nan("")}; }, 1e-4F);
  for (std::size_t i = 0; i < a_.size(); ++i) {
    EXPECT_TRUE(search_.roots(i).empty());
  }
}

//! Halves parts of the patch by the kernel for one instruction set. Returns the resulting parts as
//! (list, pair, u, v).
std::vector<std::array<float, 4>> halves_by(InstructionSet set) {
  constexpr int count = 37;
  constexpr int room = 2 * count + part_padding;
  // Every third patch is halved once.
  StarPatch patches[2] = {};
  for (StarPatch& patch : patches) {
    patch.sky = test::patch_of(fold);
    patch.error = 1e-5F;
    patch.halvings = 8;
  }
  patches[1].halvings = 1;
  std::vector<SearchedPair> pairs;
  pairs.reserve(count);
  for (int i = 0; i < count; ++i) {
    pairs.push_back({i % 3 == 0 ? 1 : 0, 0, 1.0F, -0.001F + 0.0004F * static_cast<float>(i),
                     -0.04F + 0.002F * static_cast<float>(i), false});
  }
  std::vector<float> memory(4UL * part_channels * room);
  SeenParts lists[4];
  for (int i = 0; i < 4; ++i) {
    lists[i] = {memory.data() + i * part_channels * room, room, 0};
  }
  const auto see = cpu_kernel<SeePatchesBatch>(set);
  const SeePatchesBatch seen{{count, pairs.data(), patches}, lists[0]};
  see.run(seen, 0, see.calls(seen));
  lists[0].count = count;
  cpu_kernel<HalvePartsBatch>(set).run({lists[0], 0, count, 0, {&lists[1], &lists[2], &lists[3]}}, 0, 1);
  std::vector<std::array<float, 4>> listed;
  for (int list = 1; list < 4; ++list) {
    const SeenParts& parts = lists[list];
    for (int i = 0; i < parts.count; ++i) {
      listed.push_back({static_cast<float>(list), parts.at[part_pair * room + i], parts.at[part_u * room + i],
                        parts.at[part_v * room + i]});
    }
  }
  std::ranges::sort(listed);
  return listed;
}

TEST(PartsOfPatches, AreTheSameForEveryInstructionSet) {
  const auto expected = halves_by(InstructionSet::portable);
  EXPECT_GT(expected.size(), 40U);
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
    if (has_instruction_set(set)) {
      EXPECT_EQ(halves_by(set), expected) << name_of(set);
    }
  }
}

}  // namespace
}  // namespace ergodome
