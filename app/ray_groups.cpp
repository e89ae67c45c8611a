#include "app/ray_groups.h"

#include <algorithm>

#include "app/interrupt.h"
#include "app/progress.h"
#include "kernels/core/error.h"

namespace ergodome {

namespace {

bool same_camera(const RayRow& a, const RayRow& b) {
  return a.spin == b.spin && a.r == b.r && a.theta == b.theta && a.motion == b.motion && a.velocity.x == b.velocity.x &&
         a.velocity.y == b.velocity.y && a.velocity.z == b.velocity.z;
}

}  // namespace

void for_each_camera(const std::vector<RayRow>& rows, const std::function<void(std::size_t, std::size_t)>& work) {
  constexpr std::size_t longest_run = 1'000'000;
  Progress progress("tracing", static_cast<long>(std::max<std::size_t>(rows.size(), 1)));
  for (std::size_t begin = 0; begin < rows.size();) {
    std::size_t end = begin + 1;
    while (end < rows.size() && end - begin < longest_run && same_camera(rows[begin], rows[end])) {
      ++end;
    }
    if (interrupted()) {
      throw Error("trace", "stopped; nothing was written", "run it again");
    }
    work(begin, end);
    begin = end;
    progress.advance_to(static_cast<long>(end));
  }
}

}  // namespace ergodome
