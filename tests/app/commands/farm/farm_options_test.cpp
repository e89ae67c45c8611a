#include "app/commands/farm/farm_options.h"

#include <gtest/gtest.h>

namespace ergodome {
namespace {

TEST(FarmOptions, ReadMemoryWithItsUnit) {
  EXPECT_EQ(memory_mib("500"), 500);
  EXPECT_EQ(memory_mib("500M"), 500);
  EXPECT_EQ(memory_mib("8g"), 8192);
  EXPECT_EQ(memory_mib("2T"), 2 * 1024 * 1024);
  EXPECT_EQ(memory_mib("1K"), 1);
}

TEST(FarmOptions, RejectWhatIsNoMemory) {
  for (const char* text : {"", "G", "8GB", "-1", "0", "8 G", "1e3", "99999999999999999999"}) {
    EXPECT_EQ(memory_mib(text), 0) << text;
  }
}

}  // namespace
}  // namespace ergodome
