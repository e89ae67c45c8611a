#pragma once

#include <string_view>

namespace ergodome {

//! The instruction sets that CPU kernels are compiled for.
enum class InstructionSet { portable, avx2, avx512 };

//! The best set that both this program and this processor have; asked once.
//!
//! The environment variable ERGODOME_INSTRUCTION_SET (portable, avx2, avx512) lowers the choice, for tests and comparisons; a
//! set that is not there, or another word, is ignored.
InstructionSet active_instruction_set();

//! Whether this program holds kernels for the set and this processor can run them.
bool has_instruction_set(InstructionSet set);

std::string_view name_of(InstructionSet set);

}  // namespace ergodome
