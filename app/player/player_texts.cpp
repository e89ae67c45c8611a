#include "app/player/player_texts.h"

#include <fmt/format.h>

#include "app/player/stereo_controls.h"

namespace ergodome {

std::string times_text(const PictureReport& report, const StereoSettings& stereo, const std::string& backend,
                       const std::string& language) {
  std::string text = fmt::format(
      fmt::runtime(language == "de" ? "{:.1f} ms bei {} px, Linse {}, {}" : "{:.1f} ms at {} px, {} lens, {}"),
      report.frame_time_ms, report.size_px, report.lens, backend);
  if (eye_count(stereo) > 1) {
    text += fmt::format("\n{}", disparity_caption(stereo, report.disparity, language));
    if (report.reduced) {
      text += fmt::format(
          fmt::runtime(language == "de" ? "\nBasis hier auf {:.4g} M begrenzt" : "\nbaseline limited to {:.4g} M here"),
          report.reduced->baseline);
    }
  }
  return text;
}

std::string title_text(const PictureReport& report, const PlayerSession& session, const std::string& backend) {
  const PlayerFrame& frame = session.frame();
  return fmt::format("Ergodome  {}  a {:.6g}  r {:.4g} M  {:.1f} s  {:.1f} ms at {} px  {} lens  {}{}",
                     text_in(session.show().title, session.playback().language()), session.spacetime().spin,
                     frame.pose.r, frame.time_s, report.frame_time_ms, report.size_px, report.lens, backend,
                     session.flying()                       ? "  free flight"
                     : session.playback().instant().playing ? ""
                                                            : "  paused");
}

Caption help_caption(const std::string& help) {
  Caption caption;
  caption.position.elevation_deg = 32.0;
  caption.letter_deg = 1.6;
  caption.width_deg = 80.0;
  caption.text = {{"en", help}};
  return caption;
}

}  // namespace ergodome
