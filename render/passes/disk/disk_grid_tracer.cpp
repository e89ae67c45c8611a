#include "render/passes/disk/disk_grid_tracer.h"

namespace ergodome {

namespace {

constexpr const char* disk_grid_in_the_making = "disk grid being traced";

//! Ensures a capacity of `count` elements; existing contents may be lost.
template <class T>
void make_disk_room(Buffer<T>& buffer, std::size_t count) {
  if (buffer.size() < count) {
    buffer = Buffer<T>(Backend::cpu, count + count / 2, disk_grid_in_the_making);
  }
}

template <class T>
void put_on_disk_grid(Buffer<T>& buffer, const std::vector<T>& from) {
  make_disk_room(buffer, from.size());
  buffer.write(from.data(), from.size());
}

}  // namespace

void DiskGridTracer::begin(const DiskGridCamera& camera, const AberrationOf<float>& observer, double pixel,
                           const DiskSpanOnScreen& span, bool nearness) {
  camera_ = camera;
  observer_ = observer;
  pixel_ = static_cast<float>(pixel);
  span_ = span;
  has_nearness_ = nearness;
  node_count_ = 0;
}

void DiskGridTracer::reserve_nodes(int count) {
  const std::size_t floats = floats_a_node * static_cast<std::size_t>(count);
  const auto reserve = [&](Buffer<float>& set) {
    if (set.size() < floats) {
      const std::vector<float> kept = copied(set);
      set = Buffer<float>(Backend::cpu, 2 * floats, disk_grid_in_the_making);
      set.write(kept.data(), kept.size());
    }
  };
  for (int set = 0; set < sets(); ++set) {
    reserve(nodes_[set]);
  }
  if (has_nearness_) {
    reserve(nearness_);
  }
}

void DiskGridTracer::add_nodes(const std::vector<float>& gamma_turns, const std::vector<float>& s) {
  const int count = static_cast<int>(gamma_turns.size());
  reserve_nodes(node_count_ + count);
  put_on_disk_grid(gamma_turns_, gamma_turns);
  put_on_disk_grid(s_, s);
  DiskNodeBatch batch{camera_, count, gamma_turns_.data(), s_.data(), {}, nullptr};
  const std::size_t first = floats_a_node * static_cast<std::size_t>(node_count_);
  for (int set = 0; set < sets(); ++set) {
    batch.nodes[set] = nodes_[set].data() + first;
  }
  batch.nearness = has_nearness_ ? nearness_.data() + first : nullptr;
  launch(batch);
  node_count_ += count;
}

std::vector<float> DiskGridTracer::copied(const Buffer<float>& set) const {
  std::vector<float> copy(floats_a_node * static_cast<std::size_t>(node_count_));
  set.read(copy.data(), copy.size());
  return copy;
}

float DiskGridTracer::u_at(int order, int node) const {
  const std::size_t first = floats_a_node * static_cast<std::size_t>(node);
  return camera_.pattern ? nodes_[order].data()[first] : nodes_[0].data()[first + static_cast<std::size_t>(order)];
}

void DiskGridTracer::check(const std::vector<GridCell>& cells) {
  const std::size_t checks = checks_a_cell * cells.size();
  put_on_disk_grid(cells_, cells);
  make_disk_room(error_px_, checks);
  make_disk_room(area_px_, checks);
  DiskCheckBatch batch{camera_,          observer_,       pixel_, span_, static_cast<int>(checks), cells_.data(), {},
                       error_px_.data(), area_px_.data(), {},     {}};
  for (int order = 0; order < layer_orders; ++order) {
    make_disk_room(u_[order], checks);
    make_disk_room(width_[order], checks);
    batch.nodes[order] = nodes_[order].data();
    batch.u[order] = u_[order].data();
    batch.width[order] = width_[order].data();
  }
  launch(batch);
}

}  // namespace ergodome
