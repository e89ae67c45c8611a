#include "app/player/numbered_records.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

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

TEST_F(NumberedRecords, BeginWithOne) { EXPECT_EQ(next_record(folder_ / "flight.toml"), folder_ / "flight-0001.toml"); }

TEST_F(NumberedRecords, HaveNumbersAboveAllThatAreThere) {
  for (const char* name : {"flight-0002.toml", "flight-0041.toml", "flight-0007.toml"}) {
    make(name);
  }
  EXPECT_EQ(next_record(folder_ / "flight.toml"), folder_ / "flight-0042.toml");
}

TEST_F(NumberedRecords, GoOnBeyondFourDigits) {
  make("flight-9999.toml");
  EXPECT_EQ(next_record(folder_ / "flight.toml"), folder_ / "flight-10000.toml");
  make("flight-10000.toml");
  EXPECT_EQ(next_record(folder_ / "flight.toml"), folder_ / "flight-10001.toml");
}

TEST_F(NumberedRecords, AreNoFilesOfOtherNames) {
  for (const char* name : {"flight.toml", "flight-0007.toml.bak", "flight-7.toml", "flight-00x7.toml",
                           "my-flight-0007.toml", "flight-.toml"}) {
    EXPECT_EQ(record_number("flight.toml", name), std::nullopt) << name;
  }
  EXPECT_EQ(record_number("flight.toml", "flight-0007.toml"), 7);
}

TEST_F(NumberedRecords, OfTheLeastNumbersGoBeyondALimit) {
  for (const char* name :
       {"flight-0008.toml", "flight-0009.toml", "flight-10000.toml", "flight.toml", "other-0001.toml"}) {
    make(name);
  }
  remove_oldest_records(folder_ / "flight.toml", 2);
  EXPECT_EQ(there(),
            (std::set<std::string>{"flight-0009.toml", "flight-10000.toml", "flight.toml", "other-0001.toml"}));
}

}  // namespace
}  // namespace ergodome
