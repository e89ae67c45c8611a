#include "render/stars/patch_roots.h"

#include <algorithm>
#include <cmath>

namespace ergodome {

namespace {

//! Halvings of a patch that is not regular, in search of its images.
constexpr int deepest_search = 8;
//! Roots of a patch that are nearer to each other are one.
constexpr float same_root = 2e-3F;
//! Images are sought so far beyond a patch, in parts of it: on borders, neither side may lose one.
constexpr float beyond = 2e-3F;

bool within(const Root& root, float u, float v, float size_u, float size_v, float margin) {
  return root.u > u - margin * size_u && root.u < u + (1.0F + margin) * size_u && root.v > v - margin * size_v &&
         root.v < v + (1.0F + margin) * size_v;
}

//! Halves a patch in search of all its roots.
class RootSearch {
 public:
  RootSearch(const PlanePatch& patch, bool one_to_one) : patch_(patch), one_to_one_(one_to_one) {}

  const std::vector<Root>& run() {
    follow(patch_, 0.0F, 0.0F, 1.0F, 1.0F, 0);
    return roots_;
  }

 private:
  void follow(const PlanePatch& part, float u, float v, float size_u, float size_v, int depth) {
    if ((one_to_one_ && !roots_.empty()) || !may_hold_origin(part)) {
      return;
    }
    if (depth >= deepest_search) {
      Root root = {u + 0.5F * size_u, v + 0.5F * size_v};
      if (find_origin(patch_, root.u, root.v) && within(root, u, v, size_u, size_v, 1.0F)) {
        add(root);
      }
      return;
    }
    const int axis = size_u >= size_v ? 0 : 1;
    PlanePatch halves[2];
    split(part, axis, halves[0], halves[1]);
    (axis == 0 ? size_u : size_v) *= 0.5F;
    follow(halves[0], u, v, size_u, size_v, depth + 1);
    (axis == 0 ? u : v) += axis == 0 ? size_u : size_v;
    follow(halves[1], u, v, size_u, size_v, depth + 1);
  }

  void add(const Root& root) {
    const bool known = std::ranges::any_of(roots_, [&](const Root& other) {
      return std::abs(other.u - root.u) < same_root && std::abs(other.v - root.v) < same_root;
    });
    if (!known && within(root, 0.0F, 0.0F, 1.0F, 1.0F, beyond)) {
      roots_.push_back(root);
    }
  }

  const PlanePatch& patch_;
  bool one_to_one_;
  std::vector<Root> roots_;
};

}  // namespace

void find_roots(const PlanePatch& plane, PatchShape shape, std::vector<Root>& roots) {
  if (!may_hold_origin(plane)) {
    return;
  }
  Root root = {0.5F, 0.5F};
  if (shape != PatchShape::folded && find_origin(plane, root.u, root.v) &&
      within(root, 0.0F, 0.0F, 1.0F, 1.0F, beyond)) {
    return roots.push_back(root);
  }
  if (shape != PatchShape::regular) {
    const std::vector<Root> found = RootSearch(plane, shape == PatchShape::bent).run();
    roots.insert(roots.end(), found.begin(), found.end());
  }
}

}  // namespace ergodome
