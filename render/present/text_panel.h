#pragma once

#include <memory>
#include <string>

#include "render/output/text_image.h"

namespace ergodome {

//! Where a panel is in its framebuffer. A dome leaves the corner free. `bottom_middle` may be raised, above the legend of a heat map for one.
enum class PanelPlace { top_middle, top_left, middle, bottom_middle };

//! Lines of text on a dark panel, drawn over what is in a framebuffer.
class TextPanel {
 public:
  //! Needs the OpenGL context current in which it will draw, and keeps to it.
  TextPanel();
  ~TextPanel();
  TextPanel(const TextPanel&) = delete;
  TextPanel& operator=(const TextPanel&) = delete;

  //! Takes over lines of text; none where it is empty, or where no font is installed. `widest_px`: as of text_lines_image().
  void set(const std::string& text, int font_px, TextFace face = TextFace::proportional, int widest_px = 0);

  //! Of what it shows now [px]; 0 where that is nothing.
  [[nodiscard]] int height_px() const;

  //! Draws it at its place in the bound framebuffer of the given size; at the bottom above `raised`, a part of the height.
  void draw(int framebuffer_width, int framebuffer_height, PanelPlace place = PanelPlace::top_middle,
            double raised = 0.0);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ergodome
