#include "content/files/whole_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/errors.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class WholeFile : public test::FolderTest {};

TEST_F(WholeFile, IsReadByteForByte) {
  std::ofstream(folder_ / "a.bin", std::ios::binary) << std::string("a\0\r\n", 4);
  EXPECT_EQ(read_whole_file(folder_ / "a.bin", 4, "give a file"), std::string("a\0\r\n", 4));
}

TEST_F(WholeFile, ThatIsEmptyIsNoError) {
  std::ofstream(folder_ / "empty").close();
  EXPECT_EQ(read_whole_file(folder_ / "empty", 4, "give a file"), "");
}

TEST_F(WholeFile, LargerThanItsBoundIsAnErrorWithTheRemedy) {
  std::ofstream(folder_ / "a.bin") << "12345";
  EXPECT_THAT(test::error_of([&] { read_whole_file(folder_ / "a.bin", 4, "give a short file"); }),
              AllOf(HasSubstr("a.bin: is larger"), HasSubstr("give a short file")));
}

TEST_F(WholeFile, ThatIsMissingOrAFolderIsAnErrorWithItsName) {
  EXPECT_THAT(test::error_of([&] { read_whole_file(folder_ / "absent", 4, "give a file"); }),
              HasSubstr("absent: does not exist"));
  EXPECT_THAT(test::error_of([&] { read_whole_file(folder_, 4, "give a file"); }), HasSubstr("is not a regular file"));
}

}  // namespace
}  // namespace ergodome
