#include "app/cli/summary_text.h"

#include <gtest/gtest.h>

namespace ergodome {
namespace {

TEST(QuantityText, HasUnitsOfSizeAndTime) {
  EXPECT_EQ(size_text(0), "0 bytes");
  EXPECT_EQ(size_text(999), "999 bytes");
  EXPECT_EQ(size_text(999'600), "1 MB");
  EXPECT_EQ(size_text(1'500'000'000), "1.5 GB");
  EXPECT_EQ(duration_text(59.0), "59 s");
  EXPECT_EQ(duration_text(59.9), "1 min");
  EXPECT_EQ(duration_text(3600.0), "1 h");
  EXPECT_EQ(duration_text(7800.0), "2 h 10 min");
  EXPECT_EQ(duration_text(86'400.0 * 3 + 3600.0 * 4), "3 d 4 h");
}

}  // namespace
}  // namespace ergodome
