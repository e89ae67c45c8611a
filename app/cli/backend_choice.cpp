#include "app/cli/backend_choice.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "app/cli/usage_error.h"
#include "content/files/console.h"
#include "kernels/core/error.h"
#include "kernels/launch/instruction_set.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

void add_backend_option(CLI::App& command, std::string& backend) {
  command.option_defaults()->group("Computation");
  command.add_option("--backend", backend, "where to compute: auto (GPU if available), cpu or cuda")
      ->check(CLI::IsMember({"auto", "cpu", "cuda"}))
      ->capture_default_str();
}

Backend choose_backend(const std::string& word) {
  if (word == "cpu") {
    return Backend::cpu;
  }
  const char* reason = cuda_unavailable_reason();
  if (reason == nullptr) {
    return Backend::cuda;
  }
  if (word == "cuda") {
    throw Error("--backend cuda", reason, "use --backend cpu");
  }
  static bool reported = false;
  if (!reported) {
    reported = true;
    print_note("rendering on {}: {}", describe(Backend::cpu), reason);
  }
  return Backend::cpu;
}

std::string describe(Backend backend) {
  if (backend == Backend::cuda) {
    return "cuda";
  }
  return fmt::format("cpu ({}, {} threads)", name_of(active_instruction_set()), thread_count());
}

namespace {

//! Returns the value of an environment variable; empty if it is not set.
std::string_view value_of(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr ? value : "";
}

void check_instruction_set(const char* variable) {
  const std::string_view wish = value_of(variable);
  std::string present;
  for (const InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
    if (has_instruction_set(set)) {
      if (wish == name_of(set)) {
        return;
      }
      present += fmt::format("{}{}", present.empty() ? "" : ", ", name_of(set));
    }
  }
  if (!wish.empty()) {
    throw UsageError(variable, fmt::format("is \"{}\", which is not available on this machine", wish),
                     "set it to one of " + present + ", or unset it");
  }
}

void check_threads(const char* variable) {
  const std::string_view wish = value_of(variable);
  int threads = 0;
  const auto [end, error] = std::from_chars(wish.data(), wish.data() + wish.size(), threads);
  if (!wish.empty() && (error != std::errc() || end != wish.data() + wish.size() || threads < 1)) {
    throw UsageError(variable, fmt::format("is \"{}\", which is not a number of threads", wish),
                     "set it to an integer of at least 1, or unset it");
  }
}

}  // namespace

void check_environment() {
  check_instruction_set("ERGODOME_INSTRUCTION_SET");
  check_threads("ERGODOME_THREADS");
}

}  // namespace ergodome
