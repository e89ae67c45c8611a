#include "app/cli/output_file.h"

#include <algorithm>
#include <cctype>

#include "app/cli/usage_error.h"
#include "kernels/core/error.h"

namespace ergodome {

void require_other_file(const std::string& option, const std::filesystem::path& written,
                        std::initializer_list<std::filesystem::path> read) {
  for (const std::filesystem::path& each : read) {
    // Files that do not exist are not equivalent.
    std::error_code not_there;
    if (std::filesystem::equivalent(written, each, not_there)) {
      throw UsageError(option + " " + written.string(), "is also the input file, which would be overwritten",
                       "choose another name");
    }
  }
}

void require_output_file(const std::string& option, const std::filesystem::path& written,
                         std::initializer_list<std::filesystem::path> read) {
  std::error_code problem;
  const std::filesystem::path folder = written.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, problem)) {
    throw Error(option + " " + written.string(), "cannot be written: the folder " + folder.string() + " does not exist",
                "create it, or choose another name");
  }
  require_other_file(option, written, read);
}

void require_other_png(const std::string& option, const std::filesystem::path& written,
                       std::initializer_list<std::filesystem::path> read) {
  std::string ending = written.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (!written.empty() && ending != ".png") {
    throw UsageError(option + " " + written.string(), "does not end in .png", "choose a name that ends in .png");
  }
  require_output_file(option, written, read);
}

}  // namespace ergodome
