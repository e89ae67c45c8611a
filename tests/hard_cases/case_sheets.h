#pragma once

#include <filesystem>

namespace ergodome::test {

//! Writes a picture of every hard case, some to a sheet: FOLDER/hard-cases-1.png and so on. A row
//! is a case: a window of the camera's sky where it is hard, and in four panels what each way
//! misses by, against rays in closed form.
void write_case_sheets(const std::filesystem::path& folder);

}  // namespace ergodome::test
