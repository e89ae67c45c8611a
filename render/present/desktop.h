#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ergodome {

//! A rectangle on the desktop that all monitors share [px]; y points downwards.
struct DesktopRectangle {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;

  bool operator==(const DesktopRectangle&) const = default;
};

struct DesktopMonitor {
  std::string name;
  DesktopRectangle screen;
  DesktopRectangle work_area;  //!< screen without bars and docks
};

//! Returns whether two rectangles have a pixel in common.
bool overlap(const DesktopRectangle& a, const DesktopRectangle& b);

//! Returns a list for messages: "0 (DP-1, 1920 x 1080 at 0, 0), 1 (HDMI-1, 1280 x 800 at 1920, 0)".
std::string monitor_list(const std::vector<DesktopMonitor>& monitors);

//! Returns a position at which a window of the size of `window` fits into a monitor's work area
//! without covering taken rectangles: on the first monitor with room, as far up, then as far to the
//! left as possible. Returns nothing if no monitor has room.
std::optional<DesktopRectangle> free_rectangle(const DesktopRectangle& window,
                                               const std::vector<DesktopMonitor>& monitors,
                                               std::span<const DesktopRectangle> taken);

}  // namespace ergodome
