#include "app/player/frame_log.h"

#include <fmt/format.h>

#include <chrono>

#include "content/files/fingerprint.h"
#include "kernels/core/error.h"

namespace ergodome {

FrameLog::FrameLog(const std::string& file) {
  if (file.empty()) {
    return;
  }
  file_.open(file, std::ios::trunc);
  if (!file_) {
    throw Error(file, "cannot be written", "choose a folder that exists and is writable");
  }
  file_ << "number,time_ns,r,theta,phi,size_px,exposure,stops,language,picture,gain,shown_ms,images,waited_ms\n";
}

void FrameLog::add(const ClusterFrame& frame, const Picture& picture, const std::string& images, double waited_ms) {
  if (!wanted()) {
    return;
  }
  const std::string pixels =
      picture.rgba.empty()
          ? std::string()
          : fingerprint({reinterpret_cast<const char*>(picture.rgba.data()), picture.rgba.size() * sizeof(float)});
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  file_ << fmt::format("{},{},{},{},{},{},{},{},{},{},{:.5g},{:.3f},{},{:.3f}\n", frame.number, frame.time_ns,
                       frame.pose.r, frame.pose.theta, frame.pose.phi, frame.size_px, frame.exposure_stops,
                       frame.followed_stops.value_or(0.0), frame.language, pixels, picture.tone.gain,
                       std::chrono::duration<double, std::milli>(now).count(), images, waited_ms);
  file_.flush();
}

}  // namespace ergodome
