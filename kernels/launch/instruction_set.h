#pragma once

#include <string_view>

#include "kernels/core/error.h"

namespace ergodome {

//! The instruction sets that CPU kernels are compiled for.
enum class InstructionSet { portable, avx2, avx512 };

//! The best set that both this program and this processor have; asked once.
//!
//! The environment variable ERGODOME_INSTRUCTION_SET (portable, avx2, avx512) lowers the choice, for tests and comparisons; a
//! set that is not there, or another word, is ignored. Throws Error if the program has no kernels for this processor.
InstructionSet active_instruction_set();

//! Whether this program holds kernels for the set and this processor can run them.
bool has_instruction_set(InstructionSet set);

//! Returns the error for a processor that the program has no kernels for.
Error missing_instruction_set();

std::string_view name_of(InstructionSet set);

}  // namespace ergodome
