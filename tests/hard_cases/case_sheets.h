#pragma once

#include <filesystem>

namespace ergodome::test {

//! Writes pictures of all hard cases, several to a sheet: FOLDER/hard-cases-1.png and so on. Each
//! row is a case: a window of the camera's sky where it is hard, and four panels with the errors of
//! the methods against rays in closed form.
void write_case_sheets(const std::filesystem::path& folder);

}  // namespace ergodome::test
