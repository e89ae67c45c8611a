#include "kernels/stars/search/search_steps.h"

#include <gtest/gtest.h>

namespace ergodome {
namespace {

TEST(PairResults, AreImagesAtRootsInThePatch) {
  for (const PatchShape shape : {PatchShape::regular, PatchShape::bent}) {
    for (const PatchSide side : {PatchSide::inside, PatchSide::beside}) {
      EXPECT_EQ(pair_result(shape, side, true, 0.3F, 0.9F), PairResult::image);
      EXPECT_EQ(pair_result(shape, side, true, 1.0F, -0.001F), PairResult::image);
      EXPECT_NE(pair_result(shape, side, true, 1.01F, 0.5F), PairResult::image);
      EXPECT_NE(pair_result(shape, side, false, 0.3F, 0.9F), PairResult::image);
    }
  }
}

TEST(PairResults, OfRegularPatchesAreDecided) {
  EXPECT_EQ(pair_result(PatchShape::regular, PatchSide::inside, false, 0.5F, 0.5F), PairResult::no_image);
  EXPECT_EQ(pair_result(PatchShape::regular, PatchSide::inside, true, 3.0F, 0.5F), PairResult::no_image);
}

TEST(PairResults, OfBentPatchesAreDecidedByRootsJustOutside) {
  EXPECT_EQ(pair_result(PatchShape::bent, PatchSide::beside, true, 1.05F, 0.5F), PairResult::no_image);
  // The star is inside the patch's border, but this root is outside the patch, so there must be
  // another root.
  EXPECT_EQ(pair_result(PatchShape::bent, PatchSide::inside, true, 1.05F, 0.5F), PairResult::undecided);
  EXPECT_EQ(pair_result(PatchShape::bent, PatchSide::beside, true, 1.2F, 0.5F), PairResult::undecided);
  EXPECT_EQ(pair_result(PatchShape::bent, PatchSide::beside, false, 1.05F, 0.5F), PairResult::undecided);
}

TEST(RootsOfAPatch, AreAddedOnce) {
  const FoldedRoot roots[] = {{0.2F, 0.3F, 1.0F}};
  EXPECT_FALSE(may_add_root(roots, 1, max_roots, {0.201F, 0.299F, 1.0F}));
  EXPECT_TRUE(may_add_root(roots, 1, max_roots, {0.2F, 0.31F, 1.0F}));
}

TEST(RootsOfAPatch, AreNoMoreThanWanted) {
  const FoldedRoot roots[] = {{0.2F, 0.3F, 1.0F}};
  EXPECT_FALSE(may_add_root(roots, 1, 1, {0.7F, 0.3F, 1.0F}));
}

TEST(RootsOfAPatch, LeaveRoomBesideGuesses) {
  FoldedRoot roots[max_guesses];
  for (int i = 0; i < max_guesses; ++i) {
    roots[i] = {0.1F * static_cast<float>(i), 0.0F, 0.0F};
  }
  EXPECT_FALSE(may_add_root(roots, max_guesses, max_roots, {0.5F, 0.5F, 0.0F}));
  EXPECT_TRUE(may_add_root(roots, max_guesses, max_roots, {0.5F, 0.5F, -1.0F}));
}

TEST(RootsOfAPatch, LieInThePatch) {
  EXPECT_FALSE(may_add_root(nullptr, 0, max_roots, {1.01F, 0.5F, 1.0F}));
  EXPECT_FALSE(may_add_root(nullptr, 0, max_roots, {0.5F, NAN, 1.0F}));
}

}  // namespace
}  // namespace ergodome
