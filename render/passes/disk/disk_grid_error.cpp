#include "render/passes/disk/disk_grid_error.h"

#include "kernels/launch/launch.h"

namespace ergodome {

ScreenError measure_disk_error(const DiskGrid& grid, Spacetime spacetime, const LensPosition& position,
                               const DiskGridSettings& settings, const ChartSamples& samples) {
  const DiskChartCamera at(spacetime, position, settings);
  const std::vector<float> gamma_turns(samples.gamma_turns.begin(), samples.gamma_turns.end());
  const std::vector<float> s(samples.s.begin(), samples.s.end());
  std::vector<float> found_px(s.size());
  std::vector<float> density_px(s.size());
  launch(DiskGridCheckBatch{at.camera, grid, converted_aberration<float>(settings.observer),
                            static_cast<float>(settings.pixel), disk_span_on_screen(settings, position.r),
                            static_cast<int>(s.size()), gamma_turns.data(), s.data(), found_px.data(),
                            density_px.data()});
  const std::vector<double> error_px(found_px.begin(), found_px.end());
  std::vector<double> area_px(s.size());
  for (std::size_t i = 0; i < s.size(); ++i) {
    area_px[i] = static_cast<double>(density_px[i]) * samples.extent[i];
  }
  return bounds_of(error_px, area_px);
}

}  // namespace ergodome
