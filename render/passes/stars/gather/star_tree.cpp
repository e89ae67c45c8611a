#include "render/passes/stars/gather/star_tree.h"

#include <algorithm>
#include <nanoflann.hpp>

namespace ergodome {

namespace {

//! The stars, with the interface that the kd-tree library requires.
struct StarPoints {
  std::vector<Vector3<double>> directions;

  // NOLINTBEGIN(readability-identifier-naming): the library's names
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return directions.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t star, std::size_t axis) const {
    const Vector3<double>& d = directions[star];
    return axis == 0 ? d.x : (axis == 1 ? d.y : d.z);
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
  // NOLINTEND(readability-identifier-naming)
};

using KdTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, StarPoints>, StarPoints, 3, std::uint32_t>;

//! Collects all stars within a distance during a search.
class WithinDistance {
 public:
  WithinDistance(double square, std::vector<int>& found) : square_(square), found_(found) {}

  // NOLINTBEGIN(readability-identifier-naming): the library's names
  [[nodiscard]] std::size_t size() const { return found_.size(); }
  [[nodiscard]] bool empty() const { return found_.empty(); }
  [[nodiscard]] bool full() const { return true; }
  [[nodiscard]] double worstDist() const { return square_; }
  bool addPoint(double square, std::uint32_t star) {
    if (square < square_) {
      found_.push_back(static_cast<int>(star));
    }
    return true;
  }
  void sort() { std::ranges::sort(found_); }
  // NOLINTEND(readability-identifier-naming)

 private:
  double square_;
  std::vector<int>& found_;
};

}  // namespace

struct StarTree::Index {
  StarPoints points;
  KdTree tree;

  explicit Index(std::vector<Vector3<double>> directions) : points{std::move(directions)}, tree(3, points) {
    tree.buildIndex();
  }
};

StarTree::StarTree(const StarField& field) {
  std::vector<Vector3<double>> directions;
  directions.reserve(field.stars().size());
  for (const FieldStar& star : field.stars()) {
    directions.push_back(star.direction);
  }
  index_ = std::make_unique<Index>(std::move(directions));
}

StarTree::~StarTree() = default;
StarTree::StarTree(StarTree&& other) noexcept = default;
StarTree& StarTree::operator=(StarTree&& other) noexcept = default;

void StarTree::search(const Vector3<double>& middle, double chord, std::vector<int>& found) const {
  found.clear();
  const double point[3] = {middle.x, middle.y, middle.z};
  WithinDistance within(chord * chord, found);
  index_->tree.radiusSearchCustomCallback(point, within);
  within.sort();
}

}  // namespace ergodome
