#include "app/cli/backend_choice.h"

#include <fmt/format.h>

#include <cstdio>

#include "content/files/console.h"
#include "kernels/core/error.h"
#include "kernels/launch/parallel_for.h"

namespace ergodome {

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
  static bool said = false;
  if (!said) {
    said = true;
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

}  // namespace ergodome
