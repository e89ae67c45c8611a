#include "kernels/launch/instruction_set.h"

#include <cstdlib>

namespace ergodome {

namespace {

InstructionSet best_instruction_set() {
  return has_instruction_set(InstructionSet::avx512)     ? InstructionSet::avx512
         : has_instruction_set(InstructionSet::avx2)     ? InstructionSet::avx2
         : has_instruction_set(InstructionSet::portable) ? InstructionSet::portable
                                                         : throw missing_instruction_set();
}

InstructionSet choose_instruction_set() {
  const char* wish = std::getenv("ERGODOME_INSTRUCTION_SET");
  if (wish != nullptr) {
    for (const InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
      if (name_of(set) == wish && has_instruction_set(set)) {
        return set;
      }
    }
  }
  return best_instruction_set();
}

}  // namespace

InstructionSet active_instruction_set() {
  static const InstructionSet chosen = choose_instruction_set();
  return chosen;
}

bool has_instruction_set(InstructionSet set) {
  switch (set) {
    case InstructionSet::portable:
#if defined(ERGODOME_SIMD_PORTABLE)
      return true;
#else
      return false;
#endif
    case InstructionSet::avx2:
#if defined(ERGODOME_SIMD_AVX2)
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
#else
      return false;
#endif
    case InstructionSet::avx512:
#if defined(ERGODOME_SIMD_AVX512)
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
             __builtin_cpu_supports("fma") && __builtin_cpu_supports("f16c");
#else
      return false;
#endif
  }
  return false;
}

Error missing_instruction_set() {
  return {"this program", "contains no code for this CPU, because it was built for another machine",
          "rebuild it here, or build the CMake preset release, which supports all x86-64 CPUs"};
}

std::string_view name_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::portable:
      return "portable";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::avx512:
      return "avx512";
  }
  return "";
}

}  // namespace ergodome
