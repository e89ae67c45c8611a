#pragma once

#include <memory>
#include <string>

#include "render/output/text_image.h"

namespace ergodome {

//! Where a panel is in its framebuffer. A dome leaves the corner free. `bottom_middle` may be raised, above the legend of a heat map for one.
enum class PanelPlace { top_middle, top_left, middle, bottom_middle };

//! The ground behind letters and their dark rim: the picture itself, or a dark panel.
enum class PanelGround { none, dark };

//! A part of a framebuffer that a panel is placed in [px], from its bottom left corner. Pixels of text are `across` wide and `along` high: less than
//! 1 where eyes are squeezed into halves of a picture.
struct PanelArea {
  int left = 0;
  int bottom = 0;
  int width = 0;
  int height = 0;
  double across = 1.0;
  double along = 1.0;
};

//! Lines of text with a dark rim, drawn over what is in a framebuffer.
class TextPanel {
 public:
  //! Needs the OpenGL context current in which it will draw, and keeps to it.
  TextPanel();
  ~TextPanel();
  TextPanel(const TextPanel&) = delete;
  TextPanel& operator=(const TextPanel&) = delete;

  //! Takes over lines of text; none where it is empty, or where no font is installed. `widest_px`: as of text_lines_image().
  void set(const std::string& text, int font_px, TextFace face = TextFace::proportional, int widest_px = 0,
           PanelGround ground = PanelGround::dark);

  //! Draws it at its place in a part of the bound framebuffer; at the bottom above `raised`, a part of the height.
  void draw(const PanelArea& area, PanelPlace place, double raised = 0.0);

  //! The same in all of a framebuffer of the given size.
  void draw(int framebuffer_width, int framebuffer_height, PanelPlace place = PanelPlace::top_middle,
            double raised = 0.0);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ergodome
