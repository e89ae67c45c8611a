#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "content/camera/camera_path.h"
#include "content/show/animated_show.h"
#include "content/show/reading/show_reader.h"
#include "kernels/core/error.h"

namespace {

//! Evaluates all parts of a show that depend on time, then writes the show as text and reads that
//! text.
void use(const ergodome::Show& show) {
  for (const double time_s : {0.0, 0.5 * show.duration_s, 1e9}) {
    const ergodome::CameraPose pose = ergodome::camera_pose(show, time_s);
    const ergodome::Show now = ergodome::show_at(show, time_s);
    if (!std::isfinite(pose.r) || !(now.spin >= -1.0 && now.spin <= 1.0)) {
      std::abort();
    }
  }
  for (const ergodome::Caption& caption : show.timeline.captions) {
    for (const std::string& language : ergodome::languages(show.timeline)) {
      ergodome::text_in(caption.text, language);
    }
  }
}

}  // namespace

// Any text is either a show that survives a round trip through its text, or throws an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ergodome::Show show;
  try {
    show = ergodome::parse_show({reinterpret_cast<const char*>(data), size}, "fuzz.toml");
  } catch (const ergodome::Error&) {
    return 0;
  }
  use(show);
  const ergodome::Timeline again = ergodome::parse_show(ergodome::to_toml(show), "fuzz.toml").timeline;
  if (again.captions.size() != show.timeline.captions.size() ||
      again.animations.size() != show.timeline.animations.size() ||
      ergodome::languages(again) != ergodome::languages(show.timeline)) {
    std::abort();
  }
  return 0;
}
