#pragma once

#include "kernels/spacetime/schwarzschild/connection_table.h"

namespace ergodome {

//! Makes a table of connecting rays on all threads of the processor: solves its fans and carries them to the nodes. See ConnectionBatch.
void make_connection_table(const ConnectionBatch& batch);

}  // namespace ergodome
