#include "content/files/printable.h"

#include <gtest/gtest.h>

namespace ergodome {
namespace {

TEST(Counted, OneIsSingular) {
  EXPECT_EQ(counted(1, "gap"), "1 gap");
  EXPECT_EQ(counted(std::size_t{0}, "gap"), "0 gaps");
  EXPECT_EQ(counted(2L, "gap"), "2 gaps");
  EXPECT_EQ(counted(1, "lens", "lenses"), "1 lens");
  EXPECT_EQ(counted(3, "lens", "lenses"), "3 lenses");
}

}  // namespace
}  // namespace ergodome
