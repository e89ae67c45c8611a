#include "render/present/projectors/swap_group.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ergodome {
namespace {

using testing::HasSubstr;

unsigned int joined_group = 0;
unsigned int bound_barrier = 0;

int join(void* /*display*/, unsigned long /*drawable*/, unsigned int group) {
  joined_group = group;
  return 1;
}
int bind(void* /*display*/, unsigned int /*group*/, unsigned int barrier) {
  bound_barrier = barrier;
  return 1;
}
int refuse_to_join(void* /*display*/, unsigned long /*drawable*/, unsigned int /*group*/) { return 0; }
int have_no_barrier(void* /*display*/, unsigned int /*group*/, unsigned int barrier) { return barrier == 0 ? 1 : 0; }

class SwapGroup : public testing::Test {
 protected:
  SwapGroup() { joined_group = bound_barrier = 0; }
  int screen_ = 0;
};

TEST_F(SwapGroup, IsJoinedAndLeft) {
  EXPECT_EQ(join_swap_group({join, bind}, &screen_, 7, true), "");
  EXPECT_EQ(joined_group, 1U);
  EXPECT_EQ(bound_barrier, 1U);
  EXPECT_EQ(join_swap_group({join, bind}, &screen_, 7, false), "");
  EXPECT_EQ(joined_group, 0U);
  EXPECT_EQ(bound_barrier, 0U);
}

TEST_F(SwapGroup, ThatCannotBeJoinedLeavesTheBarrierOfTheNetwork) {
  EXPECT_THAT(join_swap_group(SwapGroupFunctions(), &screen_, 7, true), HasSubstr("no GLX_NV_swap_group"));
  EXPECT_THAT(join_swap_group({join, bind}, nullptr, 7, true), HasSubstr("network barrier is used"));
  EXPECT_THAT(join_swap_group({refuse_to_join, bind}, &screen_, 7, true), HasSubstr("refused to join"));
  EXPECT_THAT(join_swap_group({join, have_no_barrier}, &screen_, 7, true), HasSubstr("sync board"));
  EXPECT_EQ(joined_group, 0U) << "a group without a barrier would only delay";
  EXPECT_EQ(join_swap_group(SwapGroupFunctions(), &screen_, 7, false), "");
}

}  // namespace
}  // namespace ergodome
