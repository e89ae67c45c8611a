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

//! Returns the rows of a picture that are rendered at a time, which bounds memory at any size.
int rows_of_a_block(Backend backend, int width_px, int height_px);

//! Returns the rows of a block that are rendered at a time if both eyes' skies are rendered
//! alternately.
int rows_of_a_strip(int width_px);

//! Calls visit(rows) for parts of a block with at most `most` rows.
template <class Visit>
void visit_rows(const RowBlock& block, int most, const Visit& visit) {
  const int end = block.first + block.count;
  for (int row = block.first; row < end; row += most) {
    visit(RowBlock{row, std::min(most, end - row)});
  }
}

}  // namespace ergodome
