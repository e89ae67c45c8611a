#pragma once

#include <algorithm>

#include "kernels/launch/launch.h"

// Blocks of rows in which pictures are rendered.

namespace ergodome {

//! A block of rows of a picture.
struct RowBlock {
  int first;
  int count;
};

//! Returns the number of rows of a picture that are rendered at a time. Blocks bound memory for any
//! picture size.
int rows_of_a_block(Backend backend, int width_px, int height_px);

//! Returns the number of rows that are rendered at a time if the skies of two eyes are rendered
//! alternately.
int rows_of_a_strip(int width_px);

//! Divides a block into parts of at most `maximum` rows, and calls visit(rows) for each.
template <class Visit>
void visit_rows(const RowBlock& block, int maximum, const Visit& visit) {
  const int end = block.first + block.count;
  for (int row = block.first; row < end; row += maximum) {
    visit(RowBlock{row, std::min(maximum, end - row)});
  }
}

}  // namespace ergodome
