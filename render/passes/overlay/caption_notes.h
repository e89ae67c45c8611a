#pragma once

#include <string>
#include <vector>

#include "content/show/show.h"

namespace ergodome {

//! Sentences about captions whose letters no installed font has, for the person who shows them: one a language, which names its first letters.
std::vector<std::string> notes_of_captions(const Show& show);

}  // namespace ergodome
