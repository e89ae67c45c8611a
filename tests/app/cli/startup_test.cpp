#include <gmock/gmock.h>

#include "tests/app/cli/command_line.h"

namespace ergodome {
namespace {

using testing::HasSubstr;
using testing::Not;

class Startup : public test::CommandLine {};

TEST_F(Startup, LoadsNoOpenImageIO) {
  ASSERT_EQ(run("--version; LD_TRACE_LOADED_OBJECTS=1 '" ERGODOME_PROGRAM "'"), 0);
  EXPECT_THAT(output_, HasSubstr("libstdc++"));
  EXPECT_THAT(output_, Not(HasSubstr("libOpenImageIO")));
}

}  // namespace
}  // namespace ergodome
