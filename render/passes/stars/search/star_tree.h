#pragma once

#include <memory>
#include <vector>

#include "render/passes/stars/star_field.h"

namespace ergodome {

//! A kd-tree over the stars' places on the sky.
class StarTree {
 public:
  explicit StarTree(const StarField& field);
  ~StarTree();
  StarTree(StarTree&& other) noexcept;
  StarTree& operator=(StarTree&& other) noexcept;

  //! Puts the numbers of the stars nearer to `middle` (unit vector) than `chord` (the straight distance between unit vectors) into
  //! `found`, in rising order.
  void search(const Vector3<double>& middle, double chord, std::vector<int>& found) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace ergodome
