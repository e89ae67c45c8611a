#include "render/lens/grid/grid_tracer.h"

#include <type_traits>

namespace ergodome {

namespace {

constexpr std::size_t node_floats = floats_a_node;
constexpr const char* buffer_name = "lens grid being traced";

//! Makes room for `count` elements; may discard the contents.
template <class T>
void make_room(Backend backend, Buffer<T>& buffer, std::size_t count) {
  if (buffer.size() < count) {
    buffer = Buffer<T>(backend, count + count / 2, buffer_name);
  }
}

template <class T>
void put(Backend backend, Buffer<T>& buffer, const T* from, std::size_t count) {
  make_room(backend, buffer, count);
  buffer.write(from, count);
}

void run(Backend backend, const NodeBatch<float>& batch) { launch(backend, batch); }
void run(Backend, const NodeBatch<double>& batch) { launch(batch); }
void run(Backend backend, const CheckBatch<float>& batch) { launch(backend, batch); }
void run(Backend, const CheckBatch<double>& batch) { launch(batch); }
void run(Backend, const OmniNodeBatch& batch) { launch(batch); }
void run(Backend, const OmniCheckBatch& batch) { launch(batch); }

}  // namespace

template <class S, class Camera>
GridTracer<S, Camera>::GridTracer(Backend backend)
    : backend_(std::is_same_v<Camera, CameraStationOf<float>> ? backend : Backend::cpu) {}

template <class S, class Camera>
void GridTracer<S, Camera>::begin(const Grid& camera, const AberrationOf<S>& observer, double pixel) {
  camera_ = placed(camera, edge_);
  observer_ = observer;
  pixel_ = static_cast<S>(pixel);
  node_count_ = 0;
}

template <class S, class Camera>
GridCamera<S, Camera> GridTracer<S, Camera>::placed(const Grid& camera, Buffer<float>& edge) const {
  put(backend_, edge, camera.chart.edge.polar_angle, static_cast<std::size_t>(camera.chart.edge.count));
  Grid there = camera;
  there.chart.edge.polar_angle = edge.data();
  return there;
}

template <class S, class Camera>
void GridTracer<S, Camera>::reserve_nodes(int count) {
  const std::size_t floats = node_floats * static_cast<std::size_t>(count);
  if (nodes_.size() >= floats) {
    return;
  }
  const std::vector<float> kept = nodes();
  nodes_ = Buffer<float>(backend_, 2 * floats, buffer_name);
  nodes_.write(kept.data(), kept.size());
}

template <class S, class Camera>
void GridTracer<S, Camera>::trace(const Grid& camera, const std::vector<float>& gamma_turns,
                                  const std::vector<float>& s, float* nodes) {
  put(backend_, gamma_turns_, gamma_turns.data(), gamma_turns.size());
  put(backend_, s_, s.data(), s.size());
  run(backend_,
      NodeBatch<S, Camera>{camera, static_cast<int>(gamma_turns.size()), gamma_turns_.data(), s_.data(), nodes});
}

template <class S, class Camera>
void GridTracer<S, Camera>::add_nodes(const std::vector<float>& gamma_turns, const std::vector<float>& s) {
  const int count = static_cast<int>(gamma_turns.size());
  reserve_nodes(node_count_ + count);
  trace(camera_, gamma_turns, s, nodes_.data() + node_floats * static_cast<std::size_t>(node_count_));
  node_count_ += count;
}

template <class S, class Camera>
std::vector<float> GridTracer<S, Camera>::nodes() const {
  std::vector<float> copy(node_floats * static_cast<std::size_t>(node_count_));
  nodes_.read(copy.data(), copy.size());
  return copy;
}

template <class S, class Camera>
void GridTracer<S, Camera>::check(const std::vector<GridCell>& cells, CellChecks& found) {
  const std::size_t checks = checks_a_cell * cells.size();
  put(backend_, cells_, cells.data(), cells.size());
  for (Buffer<float>* buffer : {&error_px_, &area_px_, &gamma_parts_, &s_parts_}) {
    make_room(backend_, *buffer, checks);
  }
  run(backend_,
      CheckBatch<S, Camera>{camera_, observer_, pixel_, static_cast<int>(checks), cells_.data(), nodes_.data(),
                            error_px_.data(), area_px_.data(), gamma_parts_.data(), s_parts_.data()});
  const auto read = [&](const Buffer<float>& from, std::vector<float>& to) {
    to.resize(checks);
    from.read(to.data(), checks);
  };
  read(error_px_, found.error_px);
  read(area_px_, found.area_px);
  read(gamma_parts_, found.gamma_parts);
  read(s_parts_, found.s_parts);
}

template <class S, class Camera>
std::vector<float> GridTracer<S, Camera>::nodes_of(const Grid& camera, const std::vector<float>& gamma_turns,
                                                   const std::vector<float>& s) {
  Buffer<float> edge;
  const std::size_t floats = node_floats * gamma_turns.size();
  const Buffer<float> made(backend_, floats, buffer_name);
  trace(placed(camera, edge), gamma_turns, s, made.data());
  std::vector<float> copy(floats);
  made.read(copy.data(), floats);
  return copy;
}

template class GridTracer<float>;
template class GridTracer<double>;
template class GridTracer<float, OmniCameraOf<float>>;

}  // namespace ergodome
