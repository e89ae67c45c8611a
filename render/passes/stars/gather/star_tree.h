#pragma once

#include <memory>
#include <vector>

#include "render/passes/stars/star_field.h"

namespace ergodome {

//! A kd-tree of the stars' directions.
class StarTree {
 public:
  explicit StarTree(const StarField& field);
  ~StarTree();
  StarTree(StarTree&& other) noexcept;
  StarTree& operator=(StarTree&& other) noexcept;

  //! Writes the indices of the stars within `chord` (the straight distance between unit vectors) of
  //! the unit vector `middle` to `found`, in ascending order.
  void search(const Vector3<double>& middle, double chord, std::vector<int>& found) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace ergodome
