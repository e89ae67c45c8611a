#pragma once

#include <filesystem>

namespace ergodome::test {

//! Writes contact sheets of all hard cases to FOLDER/hard-cases-1.png and so on. Each row shows a
//! case: a window of the camera's sky around the hard part, and four panels with the errors of the
//! methods, as compared with rays in closed form.
void write_contact_sheets(const std::filesystem::path& folder);

}  // namespace ergodome::test
