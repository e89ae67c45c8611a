#pragma once

#include "kernels/spacetime/schwarzschild/connection_table.h"

namespace ergodome {

//! Makes a table of connecting rays on all CPU threads: solves its fans and interpolates them to
//! the nodes. See ConnectionBatch.
void make_connection_table(const ConnectionBatch& batch);

}  // namespace ergodome
