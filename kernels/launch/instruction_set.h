#pragma once

#include <string_view>

#include "kernels/core/error.h"

// Selects the instruction set of CPU kernels.
namespace ergodome {

//! The instruction sets that CPU kernels are compiled for.
enum class InstructionSet { portable, avx2, avx512 };

//! Returns the best instruction set that both this program and this CPU support; determined once.
//!
//! The environment variable ERGODOME_INSTRUCTION_SET (portable, avx2, avx512) selects a lower one,
//! for tests and comparisons; unsupported or unknown values are ignored. Throws Error if the
//! program has no kernels for this CPU.
InstructionSet active_instruction_set();

//! Returns whether this program contains kernels for the set and this CPU can run them.
bool has_instruction_set(InstructionSet set);

//! Returns the error for a CPU that the program has no kernels for.
Error missing_instruction_set();

std::string_view name_of(InstructionSet set);

}  // namespace ergodome
