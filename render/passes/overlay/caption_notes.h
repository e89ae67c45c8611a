#pragma once

#include <string>
#include <vector>

#include "content/show/show.h"

namespace ergodome {

//! Returns warnings for operators about captions whose letters no installed font contains: one per
//! language, which lists the first letters.
std::vector<std::string> notes_of_captions(const Show& show);

}  // namespace ergodome
