#include "app/player/recording/numbered_records.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "kernels/core/error.h"
#include "tests/support/folder_test.h"

namespace ergodome {
namespace {

class NumberedRecords : public test::FolderTest {
 protected:
  void make(const std::string& name) const { std::ofstream(folder_ / name) << "a flight"; }
  [[nodiscard]] std::set<std::string> there() const {
    std::set<std::string> names;
    for (const auto& each : std::filesystem::directory_iterator(folder_)) {
      names.insert(each.path().filename().string());
    }
    return names;
  }
};

TEST_F(NumberedRecords, BeginWithOne) {
  EXPECT_EQ(next_record(folder_ / "flight.toml"), folder_ / "flight-000001.toml");
}

TEST_F(NumberedRecords, HaveNumbersAboveAllThatAreThere) {
  for (const char* name : {"flight-000002.toml", "flight-000041.toml", "flight-000007.toml"}) {
    make(name);
  }
  EXPECT_EQ(next_record(folder_ / "flight.toml"), folder_ / "flight-000042.toml");
}

TEST_F(NumberedRecords, EndWhereTheirNumbersDo) {
  make("flight-999998.toml");
  EXPECT_EQ(next_record(folder_ / "flight.toml"), folder_ / "flight-999999.toml");
  make("flight-999999.toml");
  EXPECT_THROW(next_record(folder_ / "flight.toml"), Error);
}

TEST_F(NumberedRecords, AreNoFilesOfOtherNames) {
  for (const char* name : {"flight.toml", "flight-000007.toml.bak", "flight-7.toml", "flight-0000x7.toml",
                           "flight-2026.toml", "flight-20261128.toml", "my-flight-000007.toml", "flight-.toml"}) {
    EXPECT_EQ(record_number("flight.toml", name), std::nullopt) << name;
  }
  EXPECT_EQ(record_number("flight.toml", "flight-000007.toml"), 7);
}

TEST_F(NumberedRecords, OfTheLeastNumbersGoBeyondALimit) {
  for (const char* name :
       {"flight-000008.toml", "flight-000009.toml", "flight-010000.toml", "flight.toml", "other-0001.toml"}) {
    make(name);
  }
  remove_oldest_records(folder_ / "flight.toml", 2);
  EXPECT_EQ(there(),
            (std::set<std::string>{"flight-000009.toml", "flight-010000.toml", "flight.toml", "other-0001.toml"}));
}

}  // namespace
}  // namespace ergodome
