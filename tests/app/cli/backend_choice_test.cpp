#include "app/cli/backend_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <optional>
#include <string>

#include "tests/support/errors.h"

namespace ergodome {
namespace {

using testing::AllOf;
using testing::HasSubstr;

//! Checks what the program reports about its environment variables; restores them after each test.
class Environment : public testing::Test {
 protected:
  ~Environment() override {
    for (const auto& [variable, value] : before_) {
      value ? ::setenv(variable.c_str(), value->c_str(), 1) : ::unsetenv(variable.c_str());
    }
  }

  std::string complaint_about(const std::string& variable, const char* value) {
    const char* const before = std::getenv(variable.c_str());
    before_.emplace(variable, before != nullptr ? std::optional<std::string>(before) : std::nullopt);
    ::setenv(variable.c_str(), value, 1);
    return test::error_of([] { check_environment(); });
  }

 private:
  std::map<std::string, std::optional<std::string>> before_;
};

TEST_F(Environment, AnInstructionSetIsOneThatIsThere) {
  EXPECT_EQ(complaint_about("ERGODOME_INSTRUCTION_SET", "portable"), "");
  EXPECT_EQ(complaint_about("ERGODOME_INSTRUCTION_SET", ""), "");
  EXPECT_THAT(complaint_about("ERGODOME_INSTRUCTION_SET", "PORTABLE"),
              AllOf(HasSubstr("ERGODOME_INSTRUCTION_SET"), HasSubstr("\"PORTABLE\""), HasSubstr("one of portable")));
}

TEST_F(Environment, ThreadsAreANumber) {
  EXPECT_EQ(complaint_about("ERGODOME_THREADS", "2"), "");
  EXPECT_EQ(complaint_about("ERGODOME_THREADS", ""), "");
  for (const char* value : {"0", "-1", "abc", "2x", "1e3", "99999999999999"}) {
    EXPECT_THAT(complaint_about("ERGODOME_THREADS", value), HasSubstr("is not a number of threads")) << value;
  }
}

}  // namespace
}  // namespace ergodome
