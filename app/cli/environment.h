#pragma once

namespace ergodome {

//! Throws UsageError if ERGODOME_INSTRUCTION_SET or ERGODOME_THREADS has an invalid value, or one
//! that this CPU does not support. An empty value counts as not set.
void check_environment();

}  // namespace ergodome
