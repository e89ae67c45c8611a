#pragma once

#include <string>
#include <string_view>

#include "app/navigation/controls/controls.h"

namespace ergodome {

//! Formats of the help: aligned columns for monospaced fonts; cells separated by tabs, for
//! fit_list(); or lines of words for any font, with only the controller's inputs if there is one.
enum class HelpForm { columns, cells, words };

//! Choices that determine the contents of the help.
struct HelpChoice {
  bool pads = true;                           //!< includes a column for controllers
  ActionUser reader = ActionUser::presenter;  //!< visitors see only their own actions
  std::string_view language = "en";           //!< "de", otherwise English
  HelpForm form = HelpForm::columns;
};

//! Returns a list of all actions and steering: inputs of keyboard and mouse, inputs of controllers,
//! and what they do. Omits actions without inputs.
std::string help_text(const Controls& controls, const HelpChoice& choice);

}  // namespace ergodome
