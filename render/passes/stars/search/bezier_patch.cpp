#include "render/passes/stars/search/bezier_patch.h"

namespace ergodome {

BezierPatch bezier_patch(const LensGrid& grid, int leaf, float width_turns, float height) {
  BezierPatch patch{};
  float* const parts[3] = {patch.x, patch.y, patch.z};
  for (int corner = 0; corner < 4; ++corner) {
    const float* node = grid.nodes + floats_a_node * grid.leaves[4 * leaf + corner];
    const int column = corner & 1;
    const int row = corner >> 1;
    // From the corner inwards; control points are offset by a third of the derivative.
    const float along_u = (column == 0 ? width_turns : -width_turns) / 3.0F;
    const float along_v = (row == 0 ? height : -height) / 3.0F;
    for (int i = 0; i < 3; ++i) {
      const float value = node[i];
      const float by_u = along_u * node[4 + i];
      const float by_v = along_v * node[8 + i];
      const float mixed = along_u * along_v * node[12 + i];
      float* to = parts[i];
      to[4 * (3 * row) + 3 * column] = value;
      to[4 * (3 * row) + 1 + column] = value + by_u;
      to[4 * (1 + row) + 3 * column] = value + by_v;
      to[4 * (1 + row) + 1 + column] = value + by_u + by_v + mixed;
    }
  }
  return patch;
}

}  // namespace ergodome
