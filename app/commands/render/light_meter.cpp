#include "app/commands/render/light_meter.h"

#include "app/cli/interrupt.h"
#include "app/cli/progress.h"
#include "app/cli/usage_error.h"
#include "app/commands/channels/heat_map_options.h"
#include "app/commands/render/followed_light.h"
#include "app/commands/render/render_request.h"
#include "content/files/console.h"
#include "content/files/printable.h"

namespace ergodome {

void require_metering(const RenderOptions& options, const Show& show) {
  const bool meters = !options.meter.empty();
  if (!meters && options.light.empty()) {
    return;
  }
  if (!follows_exposure(options, show)) {
    throw UsageError(meters ? "--meter " + options.meter : "--light " + options.light,
                     "has no effect: the exposure of these frames is not automatic (tone.auto)", "leave it out");
  }
}

void meter_frames(const RenderOptions& options, FrameWriter& writer, int first, int last) {
  Progress progress("measuring light", last - first + 1);
  std::vector<FrameLight> light;
  for (int frame = first; frame <= last; ++frame) {
    if (interrupted()) {
      throw Error("render --meter", "stopped before all frames were measured", "run it again");
    }
    light.push_back({frame, writer.files().request_of(frame), writer.meter(frame)});
    progress.advance_to(frame - first + 1);
  }
  write_light(options.meter, light);
  print_out("light of {} in {}\n", counted(light.size(), "frame"), options.meter);
}

}  // namespace ergodome
