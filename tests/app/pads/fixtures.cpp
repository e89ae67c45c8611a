#include "tests/app/pads/fixtures.h"

#include <filesystem>

namespace ergodome::test {

HidFixture fixture(const std::string& name) {
  return load_hid_fixture(std::filesystem::path(ERGODOME_TEST_DATA_DIR) / "hid" / (name + ".toml"));
}

}  // namespace ergodome::test
