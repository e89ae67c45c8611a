#pragma once

#include <memory>
#include <string>

#include "render/output/text_image.h"

// Draws text panels over a window.

namespace ergodome {

//! The position of a panel in its framebuffer. At `top_left` a panel covers nothing of a dome's
//! circular picture. `bottom_middle` may be raised, for example above the legend of a heat map.
enum class PanelPosition { top_middle, top_left, middle, bottom_middle };

//! The background of letters and their dark rim: the picture itself, or a dark panel.
enum class PanelGround { none, dark };

//! The part of a framebuffer in which a panel is placed [px], from its bottom left corner. A pixel
//! of text is `across` framebuffer pixels wide and `along` high; these are less than 1 for eyes
//! that are squeezed into halves of a picture.
struct PanelArea {
  int left = 0;
  int bottom = 0;
  int width = 0;
  int height = 0;
  double across = 1.0;
  double along = 1.0;
};

//! Lines of text with a dark rim, drawn over the contents of a framebuffer.
class TextPanel {
 public:
  //! Binds to the current OpenGL context.
  TextPanel();
  ~TextPanel();
  TextPanel(const TextPanel&) = delete;
  TextPanel& operator=(const TextPanel&) = delete;

  //! Sets the lines of text; the panel is empty without text or without an installed font.
  //! `widest_px`: as for text_lines_image().
  void set(const std::string& text, int font_px, TextFace face = TextFace::proportional, int widest_px = 0,
           PanelGround ground = PanelGround::dark);

  //! Draws the panel in a part of the bound framebuffer. `raised`: for bottom_middle, the distance
  //! from the bottom as a fraction of the height; values below 0.05 count as 0.05.
  void draw(const PanelArea& area, PanelPosition position, double raised = 0.0);

  //! Draws the panel in a whole framebuffer of the given size.
  void draw(int framebuffer_width, int framebuffer_height, PanelPosition position = PanelPosition::top_middle,
            double raised = 0.0);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ergodome
