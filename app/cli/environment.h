#pragma once

namespace ergodome {

//! Throws UsageError where ERGODOME_INSTRUCTION_SET or ERGODOME_THREADS has a value that says nothing, or that this processor does not have. An empty one counts as not set.
void check_environment();

}  // namespace ergodome
